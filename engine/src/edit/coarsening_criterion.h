// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "field/level_stack.h"
#include "field/upsample.h"

namespace argil {

/// The coarsening criterion: how far the next coarser level may differ from a leaf before the leaf
/// has to stay.
struct CoarseningCriterion {
  float near_mm = 0.0F;   ///< within 1.5 voxels of the surface: the clay's tolerance
  float outer_mm = 0.0F;  ///< within 3 voxels: half a voxel, so that a later refinement fits in
  float voxel_mm = 0.0F;  ///< of the finer level
};

/// Of the leaves of `level`.
CoarseningCriterion coarsening_criterion(const LevelStack& stack, int level, double tolerance_mm);

/// Whether one node's value and what the coarser level says there differ by more than that.
inline bool node_misses(float value, float coarse, const CoarseningCriterion& allows) noexcept {
  const float away = std::min(std::abs(value), std::abs(coarse));
  const float allowed = away < 1.5F * allows.voxel_mm ? allows.near_mm : allows.outer_mm;
  return (away < 3.0F * allows.voxel_mm) & (std::abs(value - coarse) > allowed);
}

/// Whether they do at some node of a leaf.
bool coarser_misses(const float* values, const CoarseNodes& coarse,
                    const CoarseningCriterion& allows);

}  // namespace argil
