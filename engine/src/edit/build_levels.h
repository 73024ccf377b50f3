// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "argil/core/vec3.h"
#include "argil/engine/clay_options.h"

#include "field/level_stack.h"

namespace argil {

/// How many levels a clay needs so that its longest side spans at most 32 voxels of the coarsest.
int levels_for(double longest_side_mm, double finest_voxel_mm);

/// A stack from a complete level 0: builds level upon level, then prunes. `finest` holds distances
/// in mm clamped to its background (kHalfWidthVoxels voxels), active where |phi| < background, no
/// leaf without an active node, inside tiles flood-filled. Takes it over. Has at least
/// `least_levels`. `told` is called now and then with how much is done, from 0 to 1; when it
/// returns false the work stops, and null is returned.
std::unique_ptr<LevelStack> stack_from_finest(VdbGrid::Ptr finest, const ClayOptions& options,
                                              int least_levels = 1,
                                              const std::function<bool(double)>& told = {});

/// Fills level + 1 with the averages of `level`, which covers the whole surface. `told` likewise;
/// false when it was stopped.
bool build_above(LevelStack& stack, int level, const std::function<bool(double)>& told = {});

/// Replaces coarse values under finer leaves by the restriction, which forces and distant views
/// read: at sharp edges it differs from the exact distance.
void restrict_all(LevelStack& stack);

/// A stack from an exact signed distance: coarse first, refined only where interpolation misses it.
std::unique_ptr<LevelStack> stack_from_distance(
    const std::function<double(const Vec3&)>& distance_mm, const Box3& bounds_mm,
    const ClayOptions& options);

}  // namespace argil
