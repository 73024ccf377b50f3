// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/coarsening_criterion.h"

#include <cassert>

#include "field/upsample.h"

namespace argil {

CoarseningCriterion coarsening_criterion(const LevelStack& stack, int level, double tolerance_mm) {
  assert(tolerance_mm > 0.0);
  const auto voxel = static_cast<float>(stack.voxel_mm(level));
  return {static_cast<float>(tolerance_mm), 0.5F * voxel, voxel};
}

bool coarser_misses(const float* values, const CoarseNodes& coarse,
                    const CoarseningCriterion& allows) {
  LeafValues from_coarse;
  upsample(coarse, from_coarse);
  // Counted without a branch, so that many nodes are judged at once.
  int misses = 0;
  for (std::size_t i = 0; i < kLeafNodes; ++i) {
    misses += node_misses(values[i], from_coarse[i], allows) ? 1 : 0;
  }
  return misses > 0;
}

}  // namespace argil
