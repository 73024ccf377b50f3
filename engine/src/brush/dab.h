// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/engine/tool.h"

#include "edit/edit.h"

namespace argil {

/// The finest level whose voxels a tool of this smallest radius still needs: 8 or more voxels
/// across the radius, within the levels there are.
int level_of_tool(const LevelStack& stack, double smallest_radius_mm);

/// Applies one dab and its images, or several that are joined: groups of `images`.
void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> dabs, std::size_t images);

/// Applies all of an anchored action's path so far, groups of `images` dabs, to the levels as they
/// were before the stroke.
void apply_path(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                std::size_t images);

}  // namespace argil
