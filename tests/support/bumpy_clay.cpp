// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/bumpy_clay.h"

#include <cmath>

namespace argil::test {
namespace {

/// A wave of period 1 between -1 and 1, in two parabolas: cheaper than a sine, as smooth.
double wave(double t) {
  const double s = t - std::floor(t) - 0.5;
  return 8.0 * s * (1.0 - 2.0 * std::abs(s));
}

}  // namespace

Result<Clay> bumpy_ball(double radius_mm, double voxel_mm, std::optional<double> edge_radius_mm,
                        const Vec3& center) {
  const double turn = 1.0 / (10.0 * voxel_mm);
  // The phases keep the bumps from vanishing at the nodes of coarse levels.
  const auto distance = [=](const Vec3& p) {
    const double bumps =
        wave(turn * p.x + 0.11) + wave(turn * p.y + 0.17) + wave(turn * p.z + 0.23);
    return length(p - center) - radius_mm - 0.35 * voxel_mm * bumps;
  };
  const double half = radius_mm + 2.0 * voxel_mm;
  const Vec3 reach{half, half, half};
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  options.edge_radius_mm = edge_radius_mm;
  return Clay::from_distance(distance, {center - reach, center + reach}, options);
}

}  // namespace argil::test
