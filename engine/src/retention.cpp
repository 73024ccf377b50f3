// SPDX-License-Identifier: GPL-3.0-or-later
#include "retention.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argil {

RetentionRule retention_rule(const LevelStack& stack, int level, double tolerance_mm) {
  const auto voxel = static_cast<float>(stack.voxel_mm(level));
  return {static_cast<float>(tolerance_mm), 0.5F * voxel, voxel};
}

bool coarser_misses(const LeafValues& values, const Coord& place, const CoarseReader& coarse,
                    const RetentionRule& rule) {
  LeafValues from_coarse;
  prolong_from(coarse, place, std::numeric_limits<float>::infinity(), from_coarse);
  for (std::size_t i = 0; i < kLeafNodes; ++i) {
    const float fine = std::abs(values[i]);
    const float away = std::min(fine, std::abs(from_coarse[i]));
    if (away >= 3.0F * rule.voxel_mm) continue;
    const float miss = std::abs(values[i] - from_coarse[i]);
    if (miss > (away < 1.5F * rule.voxel_mm ? rule.near_mm : rule.outer_mm)) return true;
  }
  return false;
}

bool has_band(const float* values, float band) {
  for (int i = 0; i < kLeafNodes; ++i) {
    if (std::abs(values[i]) < band) return true;
  }
  return false;
}

}  // namespace argil
