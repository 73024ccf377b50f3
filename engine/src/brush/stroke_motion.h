// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "brush/posed_tool.h"
#include "edit/edit.h"

namespace argil {

/// What one dab pushes the matter at a point by, seen from where it ends.
using Push = Vec3 (*)(const PosedTool& tool, const Vec3& point_mm);

/// Moves matter along the whole path of an anchored action: `path` holds groups of `images` dabs;
/// the pushes of a group add up, the groups follow each other. The stack must be as it was before.
void move_along(EditTarget& target, const Tool& tool, std::span<const Dab> path, std::size_t images,
                Push push);

}  // namespace argil
