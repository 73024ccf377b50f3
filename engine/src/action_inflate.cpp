// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "action.h"

namespace argil {
namespace {

/// Displacement of the middle per quarter radius of way, in smallest radii: a quarter per pass.
constexpr double kPerQuarter = 0.0625;

void stamp_level(LevelEdit& level, DabImages images, double amount_mm) {
  auto& leaves = level.leaves();
  const double most = kVoxelsPerStep * level.voxel_mm();
  const double amount = std::clamp(amount_mm, -most, most);
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    const LeafMask mask(level.stack().mask(), level.level(), leaves[n].place);
    const auto move = [&](std::size_t node, const Vec3& point, float before) {
      const double falloff = strongest_pull(images, point).falloff;
      return before - static_cast<float>(amount * falloff * mask.free_share(node));
    };
    rewrite_nodes(leaves[n], level.voxel_mm(), level.band_mm(), move);
  });
}

}  // namespace

void inflate(EditTarget& target, DabImages images, int tool_level) {
  const PosedTool& tool = images.front();
  const double amount =
      kPerQuarter * tool.dab().quarters * tool.strength() * tool.smallest_radius_mm();
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest = plan_all(edit, target.stack, images, tool_level);
    if (step == 0) steps = steps_of(amount, target.stack.voxel_mm(finest));
    for (int n = 0; n <= tool_level; ++n) stamp_level(edit.level(n), images, amount / steps);
    solve_stamped(edit);
    finish(edit);
  }
}

}  // namespace argil
