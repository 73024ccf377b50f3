// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "brush.h"

namespace argil {
namespace {

template <class Combine>
void stamp(LevelEdit& level, const PosedTool& tool, float covered, const Combine& combine) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Cover cover = cover_of(leaf.place, voxel, static_cast<double>(band), tool);
    if (cover == Cover::none) return;
    if (cover == Cover::all) {
      leaf.now.fill(covered);
      return;
    }
    for (int row = 0; row < kLeafNodes / kLeafSide; ++row) {
      const Vec3 first{voxel * (leaf.place.x() + row / kLeafSide),
                       voxel * (leaf.place.y() + row % kLeafSide), voxel * leaf.place.z()};
      const std::array<float, kLeafSide> shape = tool.shrunk_distances(first, voxel);
      const auto at = static_cast<std::size_t>(kLeafSide * row);
      for (std::size_t z = 0; z < kLeafSide; ++z) {
        leaf.now[at + z] = std::clamp(combine(leaf.before[at + z], shape[z]), -band, band);
      }
    }
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
