// SPDX-License-Identifier: GPL-3.0-or-later
// The plane is fitted again for every dab to the clay as it stands, on the tool's level; all levels
// move towards it by the same law.
#include <memory>
#include <utility>

#include "action/action.h"
#include "brush/displace.h"
#include "brush/plane_law.h"

namespace argil {
namespace {

void draw_to_plane(EditTarget& target, DabImages images, int tool_level, PlaneRule::Side side) {
  const PosedTool& tool = images.front();
  const PlaneRule rule{side, tool.tool().plane_offset, fraction_of(tool)};
  displace_in_steps(target, images, tool_level, [&](Edit& edit, DisplaceStep step) {
    auto planes =
        std::make_shared<FacedPlanes>(fit_planes(edit.level(tool_level), images, rule.raise));
    return std::make_unique<PlaneLaw>(std::move(planes), rule, step);
  });
}

}  // namespace

void actions::flatten(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, PlaneRule::Side::both);
}

void actions::scrape(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, PlaneRule::Side::above);
}

void actions::fill(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, PlaneRule::Side::below);
}

}  // namespace argil
