// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "brush.h"

namespace argil {
namespace {

/// One pass of (1, 2, 1)/4 along an axis; the ends of each line stay.
void average_axis(std::vector<float>& value, const Coord& dim, std::size_t axis) {
  const std::array<std::size_t, 3> count{static_cast<std::size_t>(dim.x()),
                                         static_cast<std::size_t>(dim.y()),
                                         static_cast<std::size_t>(dim.z())};
  const std::array<std::size_t, 3> stride{count[1] * count[2], count[2], 1};
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  for (std::size_t a = 0; a < count[u]; ++a) {
    for (std::size_t b = 0; b < count[v]; ++b) {
      const std::size_t start = a * stride[u] + b * stride[v];
      float previous = value[start];
      for (std::size_t i = 1; i + 1 < count[axis]; ++i) {
        float& here = value[start + i * stride[axis]];
        const float kept = here;
        here = 0.25F * previous + 0.5F * here + 0.25F * value[start + (i + 1) * stride[axis]];
        previous = kept;
      }
    }
  }
}

}  // namespace

SmoothTarget smooth_target(const LevelEdit& level, const Box3& bounds_mm) {
  constexpr int kMargin = 4;  // two passes, trilinear reading, and the untouched ends of the lines
  SmoothTarget target;
  target.voxel_mm = level.voxel_mm();
  const Vec3 lo = bounds_mm.min / target.voxel_mm;
  const Vec3 hi = bounds_mm.max / target.voxel_mm;
  target.box = openvdb::CoordBBox(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)).offsetBy(-kMargin),
                                  Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)).offsetBy(kMargin));
  level.gather_now(target.box, target.value);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      average_axis(target.value, target.box.dim(), axis);
    }
  }
  return target;
}

float SmoothTarget::at(const Vec3& point_mm) const noexcept {
  const Coord dim = box.dim();
  std::array<std::size_t, 3> low{};
  std::array<double, 3> share{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    const double x = std::clamp(point_mm[a] / voxel_mm - box.min()[axis], 0.0,
                                static_cast<double>(dim[axis] - 1));
    low[a] = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(dim[axis] - 2));
    share[a] = x - static_cast<double>(low[a]);
  }
  double sum = 0.0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<std::size_t, 3> node = low;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t up = (corner >> (2 - a)) & 1U;
      node[a] += up;
      weight *= up != 0 ? share[a] : 1.0 - share[a];
    }
    sum +=
        weight * static_cast<double>(value[(node[0] * static_cast<std::size_t>(dim.y()) + node[1]) *
                                               static_cast<std::size_t>(dim.z()) +
                                           node[2]]);
  }
  return static_cast<float>(sum);
}

float stamp_smooth(LevelEdit& level, const PosedTool& tool, const SmoothTarget& target, int steps) {
  auto& leaves = level.leaves();
  const float band = level.band_mm();
  const auto most = static_cast<float>(1.5 * level.voxel_mm());
  const double share = 1.0 / steps;
  std::vector<float> largest(leaves.size(), 0.0F);
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    rewrite_nodes(leaves[n], level.voxel_mm(), band, [&](const Vec3& point, float before) {
      double weight = tool.strength() * tool.falloff(point);
      if (weight <= 0.0) return before;
      if (steps > 1) weight = 1.0 - std::pow(1.0 - weight, share);
      const float move = static_cast<float>(weight) * (target.at(point) - before);
      if (std::abs(before) < band) largest[n] = std::max(largest[n], std::abs(move));
      return before + std::clamp(move, -most, most);
    });
  });
  return leaves.empty() ? 0.0F : *std::max_element(largest.begin(), largest.end());
}

}  // namespace argil
