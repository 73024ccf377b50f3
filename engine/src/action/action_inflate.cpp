// SPDX-License-Identifier: GPL-3.0-or-later
// A displacement that depends on nothing but the falloff.
#include "action/action.h"
#include "brush/displace.h"

namespace argil {
namespace {

/// Displacement of the middle per quarter radius of path, in smallest radii: a quarter per pass.
constexpr double kInflatePerQuarter = 0.0625;

}  // namespace

void actions::inflate(EditTarget& target, DabImages images, int tool_level) {
  const PosedTool& tool = images.front();
  const double amount =
      kInflatePerQuarter * tool.dab().quarters * tool.strength() * tool.smallest_radius_mm();
  displace_in_steps(target, images, tool_level, [&](Edit&, DisplaceStep step) {
    return std::make_unique<EvenLaw>(amount / step.count);
  });
}

}  // namespace argil
