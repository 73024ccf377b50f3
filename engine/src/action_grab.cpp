// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include "action.h"
#include "stroke_motion.h"

namespace argil {
namespace {

/// Matter under the tool goes its way, what is farther from its middle less.
Vec3 pull(const PosedTool& tool, const Vec3& point_mm) {
  const double falloff = tool.falloff(point_mm);
  if (falloff <= 0.0) return {};
  return (tool.strength() * falloff) * (tool.dab().at.position_mm - tool.dab().from.position_mm);
}

}  // namespace

void grab(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images) {
  move_along(target, tool, way, images, pull);
}

}  // namespace argil
