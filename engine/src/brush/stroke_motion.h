// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "brush/posed_tool.h"
#include "edit/edit.h"

namespace argil {

/// What one dab moves matter by.
struct Push {
  /// The matter at a point, seen from where it ends: at most the length of the dab's path times the
  /// tool's largest radius over its smallest.
  Vec3 (*at)(const PosedTool& tool, const Vec3& point_mm);
  /// Where that is as much everywhere, times the falloff: so much. Else null.
  Vec3 (*way)(const PosedTool& tool);
};

/// Moves matter along the whole path of an anchored action: `path` holds groups of `images` dabs;
/// the pushes of a group add up, the groups follow each other. The stack must be as it was before,
/// or as the piece of the path before left it.
void move_along(EditTarget& target, const Tool& tool, std::span<const Dab> path, std::size_t images,
                const Push& push);

}  // namespace argil
