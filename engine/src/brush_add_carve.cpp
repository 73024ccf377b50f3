// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "brush.h"

namespace argil {
namespace {

/// What the tool does to a whole leaf, when its distance to the leaf's middle already says so.
enum class Cover { none, all, some };

Cover cover_of(const LeafEdit& leaf, double voxel_mm, double band, const PosedTool& tool) {
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm;
  const Vec3 middle{voxel_mm * leaf.place.x() + half, voxel_mm * leaf.place.y() + half,
                    voxel_mm * leaf.place.z() + half};
  const double distance = tool.shrunk_distance(middle);
  const double reach = half * std::sqrt(3.0) + band;
  if (distance > reach) return Cover::none;
  return distance < -reach ? Cover::all : Cover::some;
}

template <class Combine>
void stamp(LevelEdit& level, const PosedTool& tool, float covered, Combine&& combine) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Cover cover = cover_of(leaves[n], voxel, static_cast<double>(band), tool);
    if (cover == Cover::none) return;
    if (cover == Cover::all) {
      leaves[n].now.fill(covered);
      return;
    }
    rewrite_nodes(leaves[n], voxel, band, [&](const Vec3& point, float before) {
      return combine(before, static_cast<float>(tool.shrunk_distance(point)));
    });
  });
}

}  // namespace

void stamp_add(LevelEdit& level, const PosedTool& tool) {
  stamp(level, tool, -level.band_mm(),
        [](float clay, float shape) { return std::min(clay, shape); });
}

void stamp_carve(LevelEdit& level, const PosedTool& tool) {
  stamp(level, tool, level.band_mm(),
        [](float clay, float shape) { return std::max(clay, -shape); });
}

}  // namespace argil
