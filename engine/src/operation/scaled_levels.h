// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/progress.h"

#include "field/level_stack.h"

namespace argil {

/// The same clay with all lengths times `voxel_mm` over the voxel of its finest level: each leaf at
/// its own nodes, each value times that factor, rounded to a float, so that nothing is lost of the
/// detail and what lies within the band stays within it. The mask goes along, node by node.
///
/// Shapes       `voxel_mm` from kLeastVoxelMm to kMostVoxelMm.
/// Returns      null where `progress` asked to stop. Throws bad_alloc.
/// Determinism  same bits for any number of threads.
/// Cost         a copy of the leaves.
std::unique_ptr<LevelStack> scaled_levels(const LevelStack& from, double voxel_mm,
                                          const Progress& progress);

}  // namespace argil
