// SPDX-License-Identifier: GPL-3.0-or-later
// Which leaves are no longer a distance, and how they become one again. The bounds [0.5, 2] on the
// gradient are those of docs/field.md: within them trilinear values still tell the surface to a
// fraction of a voxel and solving finds it inside the band.
#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>

#include "edit/leaf_set.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "edit/restriction.h"
#include "field/halo.h"
#include "field/nesting.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// Whether a cell of the finer level meets the node.
bool covered(const LevelStack& stack, int level, const Coord& node) {
  const auto absent = [&](const Coord& origin) { return !stack.has_leaf(level - 1, origin); };
  return level > 0 && !all_around(node << 1, absent);
}

/// Whether the level ends at the node or at a neighbour of it: the coarser level decides that one.
bool meets_border(const LevelStack& stack, int level, const Coord& node) {
  const auto present = [&](const Coord& origin) { return stack.has_leaf(level, origin); };
  if (level == stack.top()) return false;
  bool meets = !all_around(node, present);
  for (int axis = 0; axis < 3; ++axis) {
    for (int step = -1; step <= 1; step += 2) {
      Coord beside = node;
      beside[axis] += step;
      meets = meets || !all_around(beside, present);
    }
  }
  return meets;
}

void insert_with_neighbours(LeafSet& set, int level, const Coord& origin) {
  set.insert(level, origin);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-kLeafSide, kLeafSide}) {
      Coord beside = origin;
      beside[axis] += step;
      set.insert(level, beside);
    }
  }
}

/// Those of the leaves that are stored and out of bounds, in their order.
LeafList out_of_bounds_of(const LevelStack& stack, const LeafList& leaves) {
  std::vector<std::uint8_t> is_out(leaves.size(), 0);
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    const auto& [level, origin] = leaves[n];
    is_out[n] =
        stack.has_leaf(level, origin) && out_of_gradient_bounds(stack, level, origin) ? 1 : 0;
  });
  LeafList found;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (is_out[n] != 0) found.push_back(leaves[n]);
  }
  return found;
}

/// What an edit of these leaves can have put out of bounds: it may leave a border node of the leaf
/// next door without its nearer neighbour, and a leaf that it took away lays bare nodes of the one
/// above.
LeafSet affected_by(const LevelStack& stack, const LeafList& touched) {
  LeafSet all(stack.count());
  for (const auto& [level, origin] : touched) {
    insert_with_neighbours(all, level, origin);
    if (level < stack.top()) all.insert(level + 1, leaf_origin(coarser(origin)));
  }
  return all;
}

/// Passes until no leaf is out of bounds; each spreads by one leaf at most on one level.
constexpr int kMostPasses = 24;
/// Of a step: two or three are usual.
constexpr int kMostPassesOfStep = 8;

}  // namespace

bool out_of_gradient_bounds(const LevelStack& stack, int level, const Coord& origin, Coord* where,
                            const GradientBounds& bounds) {
  assert(stack.has_leaf(level, origin));
  HaloBlock block;
  gather_halo(stack, level, origin, block);
  NodeRows rows;
  row_loops().find_out_of_bounds(block, bounds, static_cast<float>(stack.voxel_mm(level)),
                                 rows.data());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (unsigned rest = rows[row]; rest != 0; rest &= rest - 1) {
      const Coord node =
          node_of(origin, kLeafSide * row + static_cast<std::size_t>(std::countr_zero(rest)));
      if (covered(stack, level, node) || meets_border(stack, level, node)) continue;
      if (where != nullptr) *where = node;
      return true;
    }
  }
  return false;
}

/// Leaves within reach take part as well: the solution must join what they hold.
LeafList redistance_out_of_bounds(EditTarget& target, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  LeafList found = out_of_bounds_of(stack, affected_by(stack, touched).list());
  if (found.empty()) return found;
  Edit edit(target);
  std::vector<std::vector<Coord>> due(static_cast<std::size_t>(stack.count()));
  for (const auto& [level, origin] : found) {
    due[static_cast<std::size_t>(level)].push_back(origin);
    openvdb::CoordBBox reached(origin, origin.offsetBy(kLeafSide - 1));
    reached.expand(kReach);
    const int n = level;
    for_each_leaf_origin(reached, [&](const Coord& near) {
      if (stack.has_leaf(n, near)) edit.want(n, near);
    });
  }
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    for (const Coord& origin : due[static_cast<std::size_t>(n)]) level.find(origin)->marked = true;
    redistance(level, Seeds::keep);
  }
  edit.drop_empty();
  edit.commit();
  return found;
}

LeafList leaves_out_of_bounds(const LevelStack& stack, const LeafList& leaves) {
  LeafSet all(stack.count());
  for (const auto& [level, origin] : leaves) insert_with_neighbours(all, level, origin);
  return out_of_bounds_of(stack, all.list());
}

bool redistance_until_in_bounds(EditTarget& target, LeafList& touched, const Progress& progress) {
  LeafList changed = touched;
  EditTarget noted = noting(target, changed);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    if (progress && !progress("redistance", static_cast<double>(pass) / kMostPasses)) return false;
    const LeafList found = leaves_out_of_bounds(target.stack, changed);
    if (found.empty()) break;
    changed.clear();
    redistance_out_of_bounds(noted, found);
    touched.insert(touched.end(), changed.begin(), changed.end());
  }
  return true;
}

LeafList redistance_touched(EditTarget& target, LeafList touched) {
  LeafSet all(target.stack.count());
  LeafList changed;
  EditTarget noted = noting(target, changed);
  for (int pass = 0; pass < kMostPassesOfStep; ++pass) {
    const LeafList found = redistance_out_of_bounds(noted, touched);
    if (changed.empty()) break;
    for (const auto& [level, origin] : changed) all.insert(level, origin);
    // What was out and did not change may do so when something near it has.
    touched = std::exchange(changed, {});
    touched.insert(touched.end(), found.begin(), found.end());
  }
  return all.list();
}

bool redistance_levels(LevelStack& stack, double tolerance_mm, const Progress& progress) {
  EditMemory memory;
  EditTarget target{stack, memory, tolerance_mm, [](const LeafChange&, const float*, float) {},
                    std::numeric_limits<std::int64_t>::max()};
  LeafList touched = out_of_bounds_of(stack, all_leaves(stack));
  if (touched.empty()) return true;
  if (!redistance_until_in_bounds(target, touched, progress)) return false;
  prune(target, touched);
  return true;
}

}  // namespace argil
