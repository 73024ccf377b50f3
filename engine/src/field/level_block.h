// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/dense_block.h"
#include "field/level_stack.h"

namespace argil {

/// How many levels beyond the coarsest `gather` can make up by leaving nodes out: more would leave
/// too few nodes within the coarsest band.
inline constexpr int kMadeUpLevels = 2;

/// Spacing of a level, which may lie up to kMadeUpLevels beyond the coarsest.
double voxel_of(const LevelStack& stack, int level) noexcept;

/// Reads a block of `level`, ignoring finer ones: nodes nearer to the surface than the band minus
/// one voxel are fixed, all others unknown with their sign.
LevelBlock gather(const LevelStack& stack, int level, const NodeBox& box);

/// Nodes along a side of the largest block that `extended_block` makes for a box of this half side.
double largest_side(const LevelStack& stack, int level, double reach_mm, double depth_mm) noexcept;

/// `box` of `level`, extended by marching to `depth_mm` on both sides; farther nodes hold
/// +-(depth + 2 voxels). Surfaces outside the box count as well: nodes at its border whose closest
/// point lies outside take their distance from a block of a coarser level that reaches that far.
LevelBlock extended_block(const LevelStack& stack, int level, const NodeBox& box, double depth_mm);

}  // namespace argil
