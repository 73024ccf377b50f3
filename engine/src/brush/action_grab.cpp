// SPDX-License-Identifier: GPL-3.0-or-later
// The push of one dab; stroke_motion.cpp adds the dabs and their images up.
#include <vector>

#include "brush/action.h"
#include "brush/stroke_motion.h"

namespace argil {
namespace {

Vec3 way_of(const PosedTool& tool) {
  return tool.strength() * (tool.dab().at.position_mm - tool.dab().from.position_mm);
}

/// Matter under the tool follows its path, what is farther from its middle less.
Vec3 pull(const PosedTool& tool, const Vec3& point_mm) {
  const double falloff = tool.falloff(point_mm);
  if (falloff <= 0.0) return {};
  return falloff * way_of(tool);
}

}  // namespace

void actions::grab(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                   std::size_t images) {
  move_along(target, tool, path, images, {pull, way_of});
}

}  // namespace argil
