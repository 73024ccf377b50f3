// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "brush/motion.h"
#include "edit/edit.h"
#include "field/mask.h"
#include "tool/posed_tool.h"

namespace argil {

/// What one dab moves matter by. Asked by several threads.
class Push {
 public:
  virtual ~Push() = default;

  /// The matter at a point, seen from where it ends: at most the length of the dab's path times the
  /// tool's largest radius over its smallest. `dab` is the number of `tool` among all.
  virtual Vec3 at(std::size_t dab, const PosedTool& tool, const Vec3& point_mm) const = 0;

  /// Where that is as much everywhere, times the falloff: so much.
  virtual std::optional<Vec3> way(const PosedTool&) const { return {}; }
};

/// Moves matter along a path: `dabs` holds groups of `images`; the pushes of a group add up, the
/// groups follow each other. The stack must be as it was before, or as the piece of the path before
/// left it.
void move_along(EditTarget& target, std::vector<PosedTool> dabs, std::size_t images, int tool_level,
                const Push& push);

/// The map of space by which `move_along` moves matter. `push` must outlive it, and `mask`, which
/// holds matter and may be null.
std::unique_ptr<const Motion> motion_along(std::vector<PosedTool> dabs, std::size_t images,
                                           const Push& push, const Mask* mask);

/// The dabs of an anchored action as tools.
std::vector<PosedTool> posed_along(const Tool& tool, std::span<const Dab> path);

/// What a strength of 1 moves matter by in the middle of a tool.
inline Vec3 way_of(const PosedTool& tool) noexcept {
  return tool.strength() * (tool.dab().at.position_mm - tool.dab().from.position_mm);
}

}  // namespace argil
