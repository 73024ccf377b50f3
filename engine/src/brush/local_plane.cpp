// SPDX-License-Identifier: GPL-3.0-or-later
// Moments of the surface under the tool, summed over the nodes within a voxel of it.
#include "brush/local_plane.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace argil {
namespace {

/// A sum that does not depend on the order of its terms.
class FixedSum {
 public:
  void add(double term) noexcept {
    assert(std::abs(term) < 1024.0);
    sum_ += std::llround(term * kScale);
  }
  double value() const noexcept { return static_cast<double>(sum_) / kScale; }

 private:
  /// Terms stay below 2^10 and are fewer than 2^20.
  static constexpr double kScale = 4294967296.0;
  std::int64_t sum_ = 0;
};

}  // namespace

std::optional<LocalPlane> plane_under(const LocalField& field, const PosedTool& tool) {
  assert(field.value.size() == static_cast<std::size_t>(field.box.volume()));
  const double h = field.voxel_mm;
  const Coord dim = field.box.dim();
  const Vec3 center = tool.middle_mm();
  const auto rows = static_cast<std::size_t>(dim.z());
  const std::array<std::size_t, 3> stride{static_cast<std::size_t>(dim.y()) * rows, rows, 1};
  FixedSum weight;
  std::array<FixedSum, 3> offset;
  std::array<FixedSum, 3> normal;
  for (int i = 1; i + 1 < dim.x(); ++i) {
    for (int j = 1; j + 1 < dim.y(); ++j) {
      for (int k = 1; k + 1 < dim.z(); ++k) {
        const std::size_t n = static_cast<std::size_t>(i) * stride[0] +
                              static_cast<std::size_t>(j) * stride[1] + static_cast<std::size_t>(k);
        const double near = 1.0 - std::abs(static_cast<double>(field.value[n])) / h;
        if (near <= 0.0) continue;
        const Coord node = field.box.min().offsetBy(i, j, k);
        const Vec3 from = Vec3{h * node.x(), h * node.y(), h * node.z()} - center;
        const Vec3 away = tool.in_radii(from);
        const double w = near * fall_off(Falloff::smooth, dot(away, away));
        if (w <= 0.0) continue;
        weight.add(w);
        for (std::size_t a = 0; a < 3; ++a) {
          const float rise = field.value[n + stride[a]] - field.value[n - stride[a]];
          normal[a].add(w * static_cast<double>(rise) / (2.0 * h));
          offset[a].add(w * from[a] / h);
        }
      }
    }
  }
  if (weight.value() <= 0.0) return std::nullopt;
  LocalPlane plane;
  for (std::size_t a = 0; a < 3; ++a) {
    plane.center_mm[a] = center[a] + h * offset[a].value() / weight.value();
    plane.normal[a] = normal[a].value();
  }
  // Where the surface faces all directions (a whole ball under the tool) no plane says anything.
  if (length(plane.normal) < 0.1 * weight.value()) return std::nullopt;
  plane.normal = normalized(plane.normal);
  return plane;
}

}  // namespace argil
