// SPDX-License-Identifier: GPL-3.0-or-later
#include "action.h"
#include "displace.h"

namespace argil {
namespace {

/// Displacement of the middle per quarter radius of way, in smallest radii: a quarter per pass.
constexpr double kInflatePerQuarter = 0.0625;

}  // namespace

void inflate(EditTarget& target, DabImages images, int tool_level) {
  const PosedTool& tool = images.front();
  const double amount =
      kInflatePerQuarter * tool.dab().quarters * tool.strength() * tool.smallest_radius_mm();
  displace_in_steps(target, images, tool_level, [&](Edit&, int steps) -> MoveLaw {
    return
        [share = amount / steps](std::size_t, const Vec3&, double pull) { return -share * pull; };
  });
}

}  // namespace argil
