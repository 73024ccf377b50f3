// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

#include "level_stack.h"

namespace argil {

/// How many levels a clay needs so that its longest side spans at most 32 voxels of the coarsest.
int levels_for(double longest_side_mm, double finest_voxel_mm);

/// A stack from a complete level 0: restricts and extends level by level, then drops every leaf
/// that the next coarser level stands for well enough. `finest` holds distances in mm clamped to
/// its background (kHalfWidthVoxels voxels), active where |phi| < background, no leaf without an
/// active node, inside tiles flood-filled. Takes it over.
std::unique_ptr<LevelStack> stack_from_finest(VdbGrid::Ptr finest, const ClayOptions& options);

/// A stack from an exact signed distance: coarse first, refined only where interpolation misses it.
std::unique_ptr<LevelStack> stack_from_distance(
    const std::function<double(const Vec3&)>& distance_mm, const Box3& bounds_mm,
    const ClayOptions& options);

}  // namespace argil
