// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/level_block.h"

namespace argil {

/// How far a block of `level` is from the distance to the finest surface: an estimate of the root
/// mean square over its nodes within `near_mm` of the surface, in mm.
///
/// Two parts, squares added. What averaging lost: the difference to the finest level that knows the
/// same node (0 where none does). What interpolating and marching lose: kBend times the second
/// differences along the three axes, which tell kinks from curves, and kFloor voxels. Where the
/// block holds no such node, kFloor voxels are all that is said.
///
/// Accuracy within a factor of 2.5 of what is measured, where that is above 0.01 voxel and nodes
///          are interpolated (WindowError.FollowsWhatIsMeasured); where they are copied it says up
///          to five times too much. What the clay's tolerance dropped is part of the surface and
///          not counted.
/// Cost     about 1 ms for 40^3 nodes.
double block_error_mm(const LevelStack& stack, int level, const LevelBlock& block, double near_mm);

}  // namespace argil
