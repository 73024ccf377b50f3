// SPDX-License-Identifier: GPL-3.0-or-later
#include "settle.h"

#include <cmath>

#include "extend.h"
#include "restriction.h"

namespace argil {
namespace {

float farthest_move(const LeafEdit& leaf) {
  float most = 0.0F;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    most = std::max(most, std::abs(leaf.now[n] - leaf.before[n]));
  }
  return most;
}

}  // namespace

void finish_displaced(EditTarget& target, Edit& edit) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    level.mark_changes();
    if (n > 0) {
      edit.restrict_to(n, RestrictedLeaves::touched);
      level.mark_changes();
    }
    const auto voxel = static_cast<float>(level.voxel_mm());
    for (const LeafEdit& leaf : level.leaves()) {
      if (leaf.changed) target.unsettled->add(n, leaf.place, farthest_move(leaf) / voxel);
    }
  }
  finish(edit);
}

void settle(EditTarget& target, std::span<const Box3> tools_mm) {
  const LevelStack& stack = target.stack;
  const auto is_behind = [&](int level, const Coord& place) {
    const openvdb::CoordBBox leaf(place, place.offsetBy(kLeafSide - 1));
    return std::none_of(tools_mm.begin(), tools_mm.end(), [&](const Box3& tool) {
      return reached_nodes(tool, stack.voxel_mm(level)).hasOverlap(leaf);
    });
  };
  Edit edit(target);
  const auto due = target.unsettled->take(is_behind);
  for (const auto& [level, place] : due) {
    if (stack.has_leaf(level, place)) edit.want(level, place);
  }
  edit.load();
  for (const auto& [level, place] : due) {
    if (LeafEdit* leaf = edit.level(level).find(place)) leaf->renew = leaf->existed;
  }
  for (int n = 0; n < edit.count(); ++n) {
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    renew(edit.level(n));
  }
  finish(edit);
}

}  // namespace argil
