// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush/pull.h"

#include <array>
#include <cassert>
#include <cmath>

namespace argil {

double layer_height_mm(const PosedTool& tool) noexcept {
  constexpr double kLayerHeight = 0.25;  // of the smallest radius: as high as inflate's whole pass
  return kLayerHeight * std::abs(tool.strength()) * tool.smallest_radius_mm();
}

PullJob pull_job(const PosedTool& tool, PullLaw law, const Vec3& origin_mm, double voxel_mm) {
  assert(voxel_mm > 0.0);
  const bool is_swept = law == PullLaw::swept_height;
  const Dab& dab = tool.dab();
  const Vec3& middle = is_swept ? dab.at.position_mm : tool.middle_mm();
  const Vec3 first = tool.in_radii(origin_mm - middle);
  const Vec3 path = is_swept ? tool.in_radii(dab.from.position_mm - middle) : Vec3{};
  const std::array<Vec3, 3> along{tool.in_radii({voxel_mm, 0.0, 0.0}),
                                  tool.in_radii({0.0, voxel_mm, 0.0}),
                                  tool.in_radii({0.0, 0.0, voxel_mm})};
  PullJob job{};
  for (std::size_t a = 0; a < 3; ++a) {
    job.first[a] = static_cast<float>(first[a]);
    job.path[a] = static_cast<float>(path[a]);
    for (std::size_t b = 0; b < 3; ++b) job.along[b][a] = static_cast<float>(along[b][a]);
  }
  const double square = dot(path, path);
  job.inverse_square = square > 0.0 ? static_cast<float>(1.0 / square) : 0.0F;
  job.height = is_swept ? static_cast<float>(layer_height_mm(tool)) : 1.0F;
  job.falloff = tool.tool().falloff;
  return job;
}

}  // namespace argil
