// SPDX-License-Identifier: GPL-3.0-or-later
// Every level that takes part is stamped with the tool's exact distance by minimum or maximum;
// leaves that the tool covers wholly, or not at all, are not evaluated node by node.
#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

#include "brush/action.h"
#include "edit/restriction.h"
#include "field/mask.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {
namespace {

enum class Stamp { add, carve };

/// The tool as a mask leaves it: m of its depth smaller, and nothing where m is 1.
void shrink(const LeafMask& leaf_mask, float deepest_mm, LeafValues& distance_mm) {
  assert(leaf_mask.has_any());
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const auto free = static_cast<float>(leaf_mask.free_fraction(n));
    if (free == 0.0F) {
      distance_mm[n] = std::numeric_limits<float>::infinity();
    } else {
      distance_mm[n] += (1.0F - free) * deepest_mm;
    }
  }
}

/// Of several tools what one of them does to a whole leaf at most.
Cover cover_of(const Coord& origin, double voxel_mm, double band_mm,
               std::span<const PosedTool> path) {
  Cover most = Cover::none;
  for (const PosedTool& tool : path) {
    const Cover cover = argil::cover_of(origin, voxel_mm, band_mm, tool);
    if (cover == Cover::all) return Cover::all;
    if (cover == Cover::some) most = Cover::some;
  }
  return most;
}

/// The distance of a leaf's nodes to the union of the tools, each shifted by a mask.
void distances_to(std::span<const PosedTool> path, const Coord& origin, double voxel_mm,
                  const LeafMask& leaf_mask, LeafValues& out) {
  LeafValues next;
  for (std::size_t i = 0; i < path.size(); ++i) {
    LeafValues& to = i == 0 ? out : next;
    path[i].shrunk_distances(origin, voxel_mm, to);
    if (leaf_mask.has_any()) shrink(leaf_mask, static_cast<float>(path[i].deepest_mm()), to);
    if (i == 0) continue;
    for (std::size_t n = 0; n < kLeafNodes; ++n) out[n] = std::min(out[n], next[n]);
  }
}

/// Every node of a level with the tools' distance, at most shifted by a mask.
template <class Combine>
void stamp_nodes(LevelEdit& level, std::span<const PosedTool> path, const Mask* mask,
                 const Combine& combine) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Cover cover = cover_of(leaf.origin, voxel, static_cast<double>(band), path);
    if (cover == Cover::none) return;
    const LeafMask leaf_mask(mask, level.level(), leaf.origin);
    LeafValues now;
    if (cover == Cover::all && !leaf_mask.has_any()) {
      now.fill(std::clamp(combine(0.0F, -2.0F * band), -band, band));
    } else {
      distances_to(path, leaf.origin, voxel, leaf_mask, now);
      const float* before = leaf.before();
      for (std::size_t i = 0; i < kLeafNodes; ++i) {
        now[i] = std::clamp(combine(before[i], now[i]), -band, band);
      }
    }
    leaf.write_all(now);
  });
}

/// Add takes the minimum of the two distances, carve the maximum with the complement of the shape.
void stamp_level(LevelEdit& level, std::span<const PosedTool> path, const Mask* mask, Stamp stamp) {
  if (stamp == Stamp::add) {
    stamp_nodes(level, path, mask, [](float clay, float shape) { return std::min(clay, shape); });
  } else {
    stamp_nodes(level, path, mask, [](float clay, float shape) { return std::max(clay, -shape); });
  }
}

/// Whether adding or carving changes anything in a leaf: not beyond the tool's band, and not where
/// there is no leaf because all of it is clay already, or air.
bool is_touched(const LevelStack& stack, int level, const Coord& origin,
                std::span<const PosedTool> path, Stamp stamp) {
  const double band = stack.band_mm(level);
  if (cover_of(origin, stack.voxel_mm(level), band, path) == Cover::none) return false;
  if (level == stack.top() || stack.has_leaf(level, origin)) return true;
  const float side = stamp == Stamp::add ? -1.0F : 1.0F;
  return any_coarse_below(stack, level + 1, origin, side, stack.band_mm(level));
}

/// What a mask shrinks is no distance any more, so it is redistanced.
void add_or_carve_masked(EditTarget& target, std::span<const PosedTool> path, int tool_level,
                         Stamp stamp) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  want_reached(edit, stack, bounds_of(path), tool_level, [](int, const Coord&) { return true; });
  edit.load();
  for (int n = 0; n < edit.count(); ++n) stamp_level(edit.level(n), path, stack.mask(), stamp);
  solve_stamped(edit);
  edit.drop_empty();
  edit.commit();
}

/// Union with the tools, or with their complement cut away. Exact distance stays exact outside the
/// union and a lower bound inside, so that no level needs solving: every level is stamped with the
/// exact shape, then coarser nodes get the restriction of the finer. Nothing for a shape that is
/// shrunk below half a voxel of the finest level: no lattice would hold it. A mask m under the tool
/// shrinks it there as a strength of 1 - m would, and then the levels are redistanced.
void add_or_carve(EditTarget& target, std::span<const PosedTool> all, int tool_level, Stamp stamp) {
  assert(target.stack.is_level(tool_level));
  const LevelStack& stack = target.stack;
  // No lattice has a node in a smaller one but by chance.
  std::vector<PosedTool> path;
  std::copy_if(all.begin(), all.end(), std::back_inserter(path), [&](const PosedTool& tool) {
    return tool.shrunk_radius_mm() >= 0.5 * stack.voxel_mm(0);
  });
  if (path.empty()) return;
  const Box3 bounds = bounds_of(path);
  if (stack.mask() != nullptr && !stack.mask()->is_zero_in(bounds)) {
    return add_or_carve_masked(target, path, tool_level, stamp);
  }
  Edit edit(target);
  want_reached(edit, stack, bounds, tool_level, [&](int level, const Coord& origin) {
    return is_touched(stack, level, origin, path, stamp);
  });
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    stamp_level(level, path, nullptr, stamp);
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
  edit.prune();
  edit.commit();
}

}  // namespace

void actions::add(EditTarget& target, ToolPath path, int tool_level) {
  add_or_carve(target, path.pieces, tool_level, Stamp::add);
}

void actions::carve(EditTarget& target, ToolPath path, int tool_level) {
  add_or_carve(target, path.pieces, tool_level, Stamp::carve);
}

}  // namespace argil
