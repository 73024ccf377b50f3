// SPDX-License-Identifier: GPL-3.0-or-later
// Displacing a level by its normals keeps it a distance but for the square of the step. So dabs
// only note how far a leaf was moved, and it is solved when that adds up to a voxel or when the
// tool has left it behind.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "edit/redistance.h"
#include "edit/restriction.h"
#include "field/parallel.h"

namespace argil {
namespace {

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

LeafList RedistanceQueue::take_due(
    const std::function<bool(int level, const Coord& origin)>& is_behind) {
  LeafList due;
  for (std::size_t n = 0; n < moved_.size(); ++n) {
    const std::size_t first = due.size();
    moved_[n].for_each([&](const Coord& origin, float voxels) {
      const int level = static_cast<int>(n);
      if (voxels > kMostVoxels || is_behind(level, origin)) due.emplace_back(level, origin);
    });
    for (std::size_t i = first; i < due.size(); ++i) moved_[n].at(due[i].second) = 0.0F;
  }
  return due;
}

void commit_displaced(EditTarget& target, Edit& edit) {
  assert(target.redistance_queue != nullptr);
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    level.mark_changes();
    if (n > 0) {
      edit.restrict_to(n, RestrictedLeaves::touched);
      level.mark_changes();
    }
    const auto voxel = static_cast<float>(level.voxel_mm());
    const std::vector<LeafEdit>& leaves = level.leaves();
    std::vector<float> moves(leaves.size(), 0.0F);
    for_each_leaf(leaves.size(), [&](std::size_t i) {
      if (leaves[i].changed) moves[i] = farthest_move(leaves[i]) / voxel;
    });
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      target.redistance_queue->mark(n, leaves[i].origin, moves[i]);
    }
  }
  edit.drop_empty();
  edit.commit();
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
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    redistance_marked(edit.level(n));
  }
  edit.drop_empty();
  edit.commit();
}

}  // namespace argil
