// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "field/found_leaves.h"

namespace argil {

/// On which side of the surface a level's tiles lie. Below the coarsest level they say nothing
/// themselves; LevelStack::sample does, and would take ten times as long for the millions of tiles
/// that a level has. To be used by one thread, and not after leaves came or went.
class TileSigns {
 public:
  /// `level` below the coarsest.
  TileSigns(const LevelStack& stack, int level)
      : leaves_(stack, level), level_(level), top_(stack.grid(stack.top()).getConstAccessor()) {
    assert(level >= 0 && level < stack.top());
  }

  /// Whether a node that the level does not store is inside.
  bool is_inside(const Coord& node) {
    const Coord coarsest = node >> (leaves_.top() - level_);
    // A leaf has a parent at every coarser level, and most tiles are far from all leaves.
    if (leaves_.values(leaves_.top(), coarsest) == nullptr) return top_.getValue(coarsest) < 0.0F;
    return sample_of(leaves_, level_, node) < 0.0F;
  }

 private:
  FoundLeaves leaves_;
  int level_;
  VdbGrid::ConstAccessor top_;
};

}  // namespace argil
