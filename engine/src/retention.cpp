// SPDX-License-Identifier: GPL-3.0-or-later
#include "retention.h"

#include <algorithm>
#include <cmath>

namespace argil {

RetentionRule retention_rule(const LevelStack& stack, int level, double tolerance_mm) {
  const auto voxel = static_cast<float>(stack.voxel_mm(level));
  return {static_cast<float>(tolerance_mm), 0.5F * voxel, voxel};
}

bool coarser_misses(const LeafValues& values, const CoarseNodes& coarse,
                    const RetentionRule& rule) {
  LeafValues from_coarse;
  upsample(coarse, from_coarse);
  // Without a branch, so that many nodes are judged at once.
  bool misses = false;
  for (std::size_t i = 0; i < kLeafNodes; ++i) {
    misses |= node_misses(values[i], from_coarse[i], rule);
  }
  return misses;
}

bool has_band(const float* values, float band) {
  bool any = false;
  for (int i = 0; i < kLeafNodes; ++i) any |= std::abs(values[i]) < band;
  return any;
}

bool has_child(const LevelStack& stack, int level, const Coord& place) {
  for (int octant = 0; level > 0 && octant < 8; ++octant) {
    if (stack.has_leaf(
            level - 1,
            (place << 1).offsetBy(octant & 4 ? 8 : 0, octant & 2 ? 8 : 0, octant & 1 ? 8 : 0))) {
      return true;
    }
  }
  return false;
}

bool is_empty(const LevelStack& stack, int level, const Coord& place) {
  const float band = stack.band_mm(level);
  return !has_band(stack.leaf(level, place)->buffer().data(), band) &&
         !has_child(stack, level, place) && !any_corner(place, [&](const Coord& node) {
           return std::abs(stack.sample(level, node)) < band;
         });
}

}  // namespace argil
