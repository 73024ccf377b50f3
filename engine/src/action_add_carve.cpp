// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <limits>

#include "action.h"
#include "mask.h"
#include "restriction.h"

namespace argil {
namespace {

/// The tool as a mask leaves it: m of its depth smaller, and nothing where m is 1.
void shrink_row(const LeafMask& held, std::size_t first_node, float deepest_mm,
                std::array<float, kLeafSide>& distance_mm) {
  for (std::size_t z = 0; z < kLeafSide; ++z) {
    const auto free = static_cast<float>(held.free_share(first_node + z));
    if (free == 0.0F) {
      distance_mm[z] = std::numeric_limits<float>::infinity();
    } else {
      distance_mm[z] += (1.0F - free) * deepest_mm;
    }
  }
}

/// Every node of a level with the tool's distance, at most shifted by a mask.
template <class Combine>
void stamp_nodes(LevelEdit& level, const PosedTool& tool, const Mask* mask,
                 const Combine& combine) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  const auto deepest = static_cast<float>(tool.deepest_mm());
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Cover cover = cover_of(leaf.place, voxel, static_cast<double>(band), tool);
    if (cover == Cover::none) return;
    const LeafMask held(mask, level.level(), leaf.place);
    if (cover == Cover::all && !held.holds_any()) {
      leaf.now.fill(std::clamp(combine(0.0F, -2.0F * band), -band, band));
      return;
    }
    for (int row = 0; row < kLeafNodes / kLeafSide; ++row) {
      const Vec3 first = place_mm(leaf.place.offsetBy(row / kLeafSide, row % kLeafSide, 0), voxel);
      std::array<float, kLeafSide> shape = tool.shrunk_distances(first, voxel);
      const auto at = static_cast<std::size_t>(kLeafSide * row);
      if (held.holds_any()) shrink_row(held, at, deepest, shape);
      for (std::size_t z = 0; z < kLeafSide; ++z) {
        leaf.now[at + z] = std::clamp(combine(leaf.before[at + z], shape[z]), -band, band);
      }
    }
  });
}

void stamp_level(LevelEdit& level, const PosedTool& tool, const Mask* mask) {
  if (tool.tool().action == Action::add) {
    stamp_nodes(level, tool, mask, [](float clay, float shape) { return std::min(clay, shape); });
  } else {
    stamp_nodes(level, tool, mask, [](float clay, float shape) { return std::max(clay, -shape); });
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

/// What a mask shrinks is no distance any more.
void add_or_carve_masked(EditTarget& target, const PosedTool& tool, int tool_level) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  plan_all(edit, stack, {&tool, 1}, tool_level);
  for (int n = 0; n < edit.count(); ++n) stamp_level(edit.level(n), tool, stack.mask());
  solve_stamped(edit);
  finish(edit);
}

}  // namespace

/// Every level is stamped with the exact shape, then the finer level's word replaces the coarser's.
void add_or_carve(EditTarget& target, const PosedTool& tool, int tool_level) {
  const LevelStack& stack = target.stack;
  if (tool.shrunk_radius_mm() < 0.5 * stack.voxel_mm(0)) return;
  if (stack.mask() != nullptr && !stack.mask()->is_zero_in(tool.bounds_mm())) {
    return add_or_carve_masked(target, tool, tool_level);
  }
  Edit edit(target);
  want_reached(edit, stack, tool.bounds_mm(), tool_level, [&](int level, const Coord& place) {
    return is_stamped(stack, level, place, tool);
  });
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    stamp_level(level, tool, nullptr);
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
  edit.drop_unneeded();
  edit.commit();
}

}  // namespace argil
