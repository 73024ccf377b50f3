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
constexpr int kMostSmoothSteps = 8;

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

/// Smoothing and inflating have stamped the tool's level and the finer ones: the coarser ones get
/// the restriction, and all are solved outward.
void solve_stamped(Edit& edit) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    level.mark_changes();
    if (n > 0) restrict_edit(edit.level(n - 1), level, RestrictedLeaves::all);
    extend(level, Seeds::normalise);
  }
}

void finish(Edit& edit) {
  edit.drop_unneeded();
  edit.commit();
}

int plan_all(Edit& edit, const LevelStack& stack, const PosedTool& tool, int tool_level) {
  return plan(edit, stack, tool.bounds_mm(), tool_level, [](int, const Coord&) { return true; });
}

/// How many steps a move of the surface takes, so that none exceeds kVoxelsPerStep.
int steps_of(double move_mm, double voxel_mm) {
  const double steps = std::ceil(std::abs(move_mm) / (kVoxelsPerStep * voxel_mm));
  return std::max(1, static_cast<int>(steps));
}

void add_or_carve(EditTarget& target, const PosedTool& tool, int tool_level) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  plan(edit, stack, tool.bounds_mm(), tool_level,
       [&](int level, const Coord& place) { return is_stamped(stack, level, place, tool); });
  stamp_exact(edit, tool);
  finish(edit);
}

void inflate(EditTarget& target, const PosedTool& tool, int tool_level, double spacing) {
  const double amount =
      kInflatePerPass * std::min(1.0, spacing) * tool.strength() * smallest_radius(tool.tool());
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest = plan_all(edit, target.stack, tool, tool_level);
    if (step == 0) steps = steps_of(amount, target.stack.voxel_mm(finest));
    for (int n = 0; n <= tool_level; ++n) stamp_inflate(edit.level(n), tool, amount / steps);
    solve_stamped(edit);
    finish(edit);
  }
}

/// Detail that is taller than a step is long takes several, up to kMostSmoothSteps: what is taller
/// still is drawn down by the next dabs.
void smooth(EditTarget& target, const PosedTool& tool, int tool_level) {
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest = plan_all(edit, target.stack, tool, tool_level);
    const SmoothTarget drawn_to = smooth_target(edit.level(tool_level), tool.bounds_mm());
    const auto stamp = [&](int n) { return stamp_smooth(edit.level(n), tool, drawn_to, steps); };
    if (step == 0) {
      const double voxel = target.stack.voxel_mm(finest);
      steps = std::min(kMostSmoothSteps, steps_of(static_cast<double>(stamp(finest)), voxel));
    }
    // The first step may be the only one, and then the finest level is stamped already.
    for (int n = 0; n <= tool_level; ++n) {
      if (n != finest || step > 0 || steps > 1) stamp(n);
    }
    solve_stamped(edit);
    finish(edit);
  }
}

}  // namespace

int level_of_tool(const LevelStack& stack, double smallest_radius_mm) {
  int level = 0;
  while (level < stack.top() && 8.0 * stack.voxel_mm(level + 1) <= smallest_radius_mm) ++level;
  return level;
}

void apply_dab(EditTarget& target, const PosedTool& tool, double spacing) {
  if (tool.strength() == 0.0) return;
  const int tool_level = level_of_tool(target.stack, smallest_radius(tool.tool()));
  switch (tool.tool().action) {
    case Action::add:
    case Action::carve:
      return add_or_carve(target, tool, tool_level);
    case Action::inflate:
      return inflate(target, tool, tool_level, spacing);
    case Action::smooth:
      return smooth(target, tool, tool_level);
  }
}

}  // namespace argil
