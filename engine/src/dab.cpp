// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "edit.h"
#include "extend.h"
#include "restriction.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

/// Displacement of the middle of one full inflate pass, in smallest radii.
constexpr double kInflatePerPass = 0.25;
/// The farthest the surface may move at once, in voxels of the finest leaf under the tool: the next
/// solving must still find it inside the band.
constexpr double kVoxelsPerStep = 1.5;

/// Nodes of a level that a tool with these bounds can change, directly or by solving distance anew.
CoordBBox reached_nodes(const Box3& bounds_mm, double voxel_mm) {
  const Vec3 lo = bounds_mm.min / voxel_mm;
  const Vec3 hi = bounds_mm.max / voxel_mm;
  CoordBBox box(Coord::floor(openvdb::Vec3d(lo.x, lo.y, lo.z)),
                Coord::ceil(openvdb::Vec3d(hi.x, hi.y, hi.z)));
  box.expand(kReach + 1);
  return box;
}

/// Leaves of a level in the node box, by walking whichever is shorter: the box or the leaves.
std::vector<Coord> leaves_in(const LevelStack& stack, int level, const CoordBBox& nodes) {
  std::vector<Coord> found;
  const Coord span = (place_of(nodes.max()) - place_of(nodes.min())) >> 3;
  const double places = (span.x() + 1.0) * (span.y() + 1.0) * (span.z() + 1.0);
  if (places < static_cast<double>(stack.grid(level).tree().leafCount())) {
    for_each_place(nodes, [&](const Coord& place) {
      if (stack.has_leaf(level, place)) found.push_back(place);
    });
    return found;
  }
  for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    const Coord origin = leaf->origin();
    if (nodes.hasOverlap(CoordBBox(origin, origin.offsetBy(kLeafSide - 1)))) {
      found.push_back(origin);
    }
  }
  return found;
}

/// Finer levels take part where they have leaves, and one leaf around, so that detail may move.
std::vector<Coord> finer_places(const LevelStack& stack, int level, const CoordBBox& nodes) {
  const CoordBBox places(place_of(nodes.min()), place_of(nodes.max()));
  std::vector<Coord> found;
  for (const Coord& place : leaves_in(stack, level, nodes)) {
    CoordBBox around(place, place);
    around.expand(kLeafSide);
    for_each_place(around, [&](const Coord& near) {
      if (places.isInside(near)) found.push_back(near);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Wants what a tool with these bounds reaches, as far as `takes_part(level, place)` says so.
/// Returns the finest level that has leaves under the tool, or the tool's level.
template <class TakesPart>
int plan(Edit& edit, const LevelStack& stack, const Box3& bounds_mm, int tool_level,
         const TakesPart& takes_part) {
  int finest = tool_level;
  for (int level = stack.top(); level >= 0; --level) {
    const CoordBBox nodes = reached_nodes(bounds_mm, stack.voxel_mm(level));
    const auto want = [&](const Coord& place) {
      if (takes_part(level, place)) edit.want(level, place);
    };
    if (level >= tool_level) {
      for_each_place(nodes, want);
      continue;
    }
    const std::vector<Coord> places = finer_places(stack, level, nodes);
    if (!places.empty()) finest = level;
    for (const Coord& place : places) want(place);
  }
  edit.load();
  return finest;
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

/// Adding and carving: every level is stamped with the exact shape, then the finer level's word
/// replaces the coarser's. No solving.
void stamp_exact(Edit& edit, const PosedTool& tool) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    if (tool.tool().action == Action::add) {
      stamp_add(level, tool);
    } else {
      stamp_carve(level, tool);
    }
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
}

/// Smoothing and inflating: the tool's level and the finer ones are stamped, the coarser ones get
/// the restriction; all are solved outward.
template <class Stamp>
void stamp_and_solve(Edit& edit, int tool_level, Stamp&& stamp) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    if (n <= tool_level) stamp(level);
    level.mark_changes();
    if (n > 0) restrict_edit(edit.level(n - 1), level, RestrictedLeaves::all);
    extend(level, Seeds::normalise);
  }
}

void finish(Edit& edit) {
  edit.drop_unneeded();
  edit.commit();
}

}  // namespace

int level_of_tool(const LevelStack& stack, double smallest_radius_mm) {
  int level = 0;
  while (level < stack.top() && 8.0 * stack.voxel_mm(level + 1) <= smallest_radius_mm) ++level;
  return level;
}

void apply_dab(EditTarget& target, const PosedTool& tool, double spacing) {
  const LevelStack& stack = target.stack;
  if (tool.strength() == 0.0) return;
  const int tool_level = level_of_tool(stack, smallest_radius(tool.tool()));
  const Action action = tool.tool().action;
  if (action == Action::add || action == Action::carve) {
    Edit edit(target);
    plan(edit, stack, tool.bounds_mm(), tool_level,
         [&](int level, const Coord& place) { return is_stamped(stack, level, place, tool); });
    stamp_exact(edit, tool);
    finish(edit);
    return;
  }
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest =
        plan(edit, stack, tool.bounds_mm(), tool_level, [](int, const Coord&) { return true; });
    const double amount =
        kInflatePerPass * std::min(1.0, spacing) * tool.strength() * smallest_radius(tool.tool());
    if (action == Action::inflate) {
      if (step == 0) {
        steps = std::max(1, static_cast<int>(std::ceil(std::abs(amount) /
                                                       (kVoxelsPerStep * stack.voxel_mm(finest)))));
      }
      stamp_and_solve(edit, tool_level,
                      [&](LevelEdit& level) { stamp_inflate(level, tool, amount / steps); });
    } else {
      if (step == 0) steps = 1 << std::min(3, tool_level - finest);
      const SmoothTarget drawn_to = smooth_target(edit.level(tool_level), tool.bounds_mm());
      stamp_and_solve(edit, tool_level, [&](LevelEdit& level) {
        stamp_smooth(level, tool, drawn_to, tool.strength() / steps);
      });
    }
    finish(edit);
  }
}

}  // namespace argil
