// SPDX-License-Identifier: GPL-3.0-or-later
// Displacing a level by its normals keeps it a distance but for the square of the step, and
// carrying matter along but for what the motion bends. So dabs only note how far a leaf was moved,
// and it is solved when that adds up to a voxel, when it is bent, or when the tool has left it
// behind.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "edit/redistance.h"
#include "edit/restriction.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// In voxels. Beyond this the band has lost a voxel on one side; with half as much again flattened
/// and inflated clay is farther from that of finer voxels.
constexpr float kMostMoved = 1.0F;

/// The farthest that a node of the leaf was moved by this edit.
float farthest_move(const LeafEdit& leaf) {
  float most = 0.0F;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    most = std::max(most, std::abs(leaf.now()[n] - leaf.before()[n]));
  }
  return most;
}

/// On the coarsest level nothing says how far the surface is where there is no leaf: one that it
/// comes near to is solved from those beside it, and stays if it holds a band.
void want_absent_beside(Edit& edit, const LevelStack& stack, const Coord& origin) {
  const openvdb::CoordBBox around(origin.offsetBy(-kLeafSide), origin.offsetBy(2 * kLeafSide - 1));
  for_each_leaf_origin(around, [&](const Coord& beside) {
    if (!stack.has_leaf(stack.top(), beside)) edit.want(stack.top(), beside);
  });
}

}  // namespace

void RedistanceQueue::mark(int level, const Coord& origin, float voxels) {
  assert(level >= 0 && is_leaf_origin(origin));
  if (voxels <= 0.0F) return;
  const auto n = static_cast<std::size_t>(level);
  if (moved_.size() <= n) moved_.resize(n + 1);
  moved_[n].at(origin) += voxels;
}

void RedistanceQueue::mark_carried(int level, const Coord& origin, bool is_bent) {
  constexpr float kHardly = 1e-3F * kMostMoved;  // of many dabs as well
  mark(level, origin, is_bent ? 2.0F * kMostMoved : kHardly);
}

bool RedistanceQueue::take_if_too_far(int level, const Coord& origin) {
  const auto n = static_cast<std::size_t>(level);
  if (n >= moved_.size() || moved_[n].get(origin) <= kMostMoved) return false;
  moved_[n].at(origin) = 0.0F;
  return true;
}

LeafList RedistanceQueue::take_due(
    const std::function<bool(int level, const Coord& origin)>& is_behind) {
  LeafList due;
  for (std::size_t n = 0; n < moved_.size(); ++n) {
    const std::size_t first = due.size();
    moved_[n].for_each([&](const Coord& origin, float voxels) {
      const int level = static_cast<int>(n);
      if (voxels > kMostMoved || is_behind(level, origin)) due.emplace_back(level, origin);
    });
    for (std::size_t i = first; i < due.size(); ++i) moved_[n].at(due[i].second) = 0.0F;
  }
  return due;
}

namespace {

/// Notes how far the leaves of a level were moved, and solves those that moved too far in all.
void solve_displaced(RedistanceQueue& queue, LevelEdit& level) {
  const auto voxel = static_cast<float>(level.voxel_mm());
  std::vector<LeafEdit>& leaves = level.leaves();
  std::vector<float> moves(leaves.size(), 0.0F);
  for_each_leaf(leaves.size(), [&](std::size_t i) {
    if (leaves[i].changed) moves[i] = farthest_move(leaves[i]) / voxel;
  });
  const bool is_coarsest = level.level() == level.stack().top();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    queue.mark(level.level(), leaves[i].origin, moves[i]);
    // The coarsest level is solved with leaves that are not there: flush_queue() does that.
    if (is_coarsest || moves[i] <= 0.0F) continue;
    leaves[i].marked = queue.take_if_too_far(level.level(), leaves[i].origin);
  }
  redistance_marked(level);
}

}  // namespace

void commit_displaced(EditTarget& target, Edit& edit) {
  assert(target.redistance_queue != nullptr);
  for (int n = 0; n < edit.count(); ++n) {
    edit.level(n).mark_changes();
    if (n > 0) {
      edit.restrict_to(n, RestrictedLeaves::touched);
      edit.level(n).mark_changes();
    }
    solve_displaced(*target.redistance_queue, edit.level(n));
  }
  edit.drop_empty();
  edit.commit();
}

void commit_carried(EditTarget& target, Edit& edit) {
  assert(target.redistance_queue != nullptr);
  for (int n = 0; n < edit.count(); ++n) {
    edit.level(n).mark_changes();
    if (n == 0) continue;
    edit.restrict_to(n, RestrictedLeaves::touched);
    edit.level(n).mark_changes();
  }
  edit.drop_empty();
  LeafList carried;
  for (int n = 0; n < edit.count(); ++n) {
    for (const LeafEdit& leaf : edit.level(n).leaves()) {
      if (leaf.changed && leaf.present) carried.emplace_back(n, leaf.origin);
    }
  }
  edit.commit();
  std::vector<std::uint8_t> is_bent(carried.size(), 0);
  for_each_leaf(carried.size(), [&](std::size_t i) {
    const auto& [level, origin] = carried[i];
    is_bent[i] =
        out_of_gradient_bounds(target.stack, level, origin, nullptr, kCarriedBounds) ? 1 : 0;
  });
  for (std::size_t i = 0; i < carried.size(); ++i) {
    target.redistance_queue->mark_carried(carried[i].first, carried[i].second, is_bent[i] != 0);
  }
}

void flush_queue(EditTarget& target, std::span<const Box3> tools_mm) {
  assert(target.redistance_queue != nullptr);
  const LevelStack& stack = target.stack;
  const auto is_behind = [&](int level, const Coord& origin) {
    const openvdb::CoordBBox leaf(origin, origin.offsetBy(kLeafSide - 1));
    return std::none_of(tools_mm.begin(), tools_mm.end(), [&](const Box3& tool) {
      return reached_nodes(tool, stack.voxel_mm(level)).hasOverlap(leaf);
    });
  };
  Edit edit(target);
  const LeafList due = target.redistance_queue->take_due(is_behind);
  for (const auto& [level, origin] : due) {
    if (!stack.has_leaf(level, origin)) continue;
    edit.want(level, origin);
    if (level == stack.top()) want_absent_beside(edit, stack, origin);
  }
  edit.load();
  for (const auto& [level, origin] : due) {
    if (LeafEdit* leaf = edit.level(level).find(origin)) leaf->marked = leaf->existed;
  }
  for (LeafEdit& leaf : edit.level(stack.top()).leaves()) {
    leaf.marked = leaf.marked || !leaf.existed;
  }
  for (int n = 0; n < edit.count(); ++n) {
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::touched);
    redistance_marked(edit.level(n));
  }
  edit.drop_empty();
  edit.commit();
}

}  // namespace argil
