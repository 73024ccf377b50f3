// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "action.h"
#include "restriction.h"

namespace argil {
namespace {

template <class Combine>
void stamp(LevelEdit& level, const PosedTool& tool, float covered, const Combine& combine) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Cover cover = cover_of(leaf.place, voxel, static_cast<double>(band), tool);
    if (cover == Cover::none) return;
    if (cover == Cover::all) {
      leaf.now.fill(covered);
      return;
    }
    for (int row = 0; row < kLeafNodes / kLeafSide; ++row) {
      const Vec3 first{voxel * (leaf.place.x() + row / kLeafSide),
                       voxel * (leaf.place.y() + row % kLeafSide), voxel * leaf.place.z()};
      const std::array<float, kLeafSide> shape = tool.shrunk_distances(first, voxel);
      const auto at = static_cast<std::size_t>(kLeafSide * row);
      for (std::size_t z = 0; z < kLeafSide; ++z) {
        leaf.now[at + z] = std::clamp(combine(leaf.before[at + z], shape[z]), -band, band);
      }
    }
  });
}

void stamp_level(LevelEdit& level, const PosedTool& tool) {
  if (tool.tool().action == Action::add) {
    stamp(level, tool, -level.band_mm(),
          [](float clay, float shape) { return std::min(clay, shape); });
  } else {
    stamp(level, tool, level.band_mm(),
          [](float clay, float shape) { return std::max(clay, -shape); });
  }
}

/// Whether adding or carving changes anything at a place: not beyond the tool's band, and not where
/// there is no leaf because all of it is clay already, or air.
bool is_stamped(const LevelStack& stack, int level, const Coord& place, const PosedTool& tool) {
  const double band = stack.band_mm(level);
  if (cover_of(place, stack.voxel_mm(level), band, tool) == Cover::none) return false;
  if (level == stack.top() || stack.has_leaf(level, place)) return true;
  const float side = tool.tool().action == Action::add ? -1.0F : 1.0F;
  const CoarseNodes coarse = coarse_nodes(stack, level + 1, place);
  return std::any_of(coarse.begin(), coarse.end(),
                     [&](float value) { return side * value < stack.band_mm(level); });
}

}  // namespace

/// Every level is stamped with the exact shape, then the finer level's word replaces the coarser's.
void add_or_carve(EditTarget& target, const PosedTool& tool, int tool_level) {
  const LevelStack& stack = target.stack;
  if (tool.shrunk_radius_mm() < 0.5 * stack.voxel_mm(0)) return;
  Edit edit(target);
  want_reached(edit, stack, tool.bounds_mm(), tool_level, [&](int level, const Coord& place) {
    return is_stamped(stack, level, place, tool);
  });
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    stamp_level(level, tool);
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
  edit.drop_unneeded();
  edit.commit();
}

}  // namespace argil
