// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <vector>

#include "field/leaf_finder.h"
#include "field/level_stack.h"

namespace argil {

/// On which side of the surface a level's tiles lie. Below the coarsest level they say nothing
/// themselves; LevelStack::sample does, and takes ten times as long: a level has millions of tiles,
/// most of them far from all leaves, and the others have their middle on a node of a coarser level.
/// To be used by one thread, and not after leaves came or went.
class TileSigns {
 public:
  /// `level` below the coarsest.
  TileSigns(const LevelStack& stack, int level)
      : stack_(&stack), level_(level), top_(stack.grid(stack.top()).getConstAccessor()) {
    assert(level >= 0 && level < stack.top());
    for (int above = level + 1; above <= stack.top(); ++above) finders_.emplace_back(stack, above);
  }

  /// Whether a node that the level does not store is inside.
  bool is_inside(const Coord& node) {
    const int most = static_cast<int>(finders_.size());
    // A leaf has a parent at every coarser level.
    if (!finders_.back().has_leaf(node >> most)) return top_.getValue(node >> most) < 0.0F;
    for (int steps = 1; steps <= most; ++steps) {
      const Coord low = node >> steps;
      const float* values = finders_[static_cast<std::size_t>(steps - 1)].values(low);
      if (values == nullptr) continue;
      if (low << steps == node) return values[leaf_offset(low)] < 0.0F;
      break;
    }
    return stack_->sample(level_, node) < 0.0F;
  }

 private:
  const LevelStack* stack_;
  int level_;
  std::vector<LeafFinder> finders_;  ///< of the coarser levels
  VdbGrid::ConstAccessor top_;
};

}  // namespace argil
