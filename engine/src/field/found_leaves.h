// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <vector>

#include "field/leaf_finder.h"
#include "field/level_stack.h"
#include "field/sampling.h"

namespace argil {

/// The leaves of a level and coarser ones, as sampling.h asks for them: LevelStack::sample for
/// somebody who asks for nodes that lie together. To be used by one thread, and not after leaves
/// came or went.
class FoundLeaves {
 public:
  FoundLeaves(const LevelStack& stack, int from) : stack_(&stack), from_(from) {
    for (int level = from; level < stack.count(); ++level) finders_.emplace_back(stack, level);
  }

  int top() const noexcept { return stack_->top(); }
  const float* values(int level, const Coord& node) const {
    assert(level >= from_ && level <= top());
    return finders_[static_cast<std::size_t>(level - from_)].values(node);
  }
  float constant(const Coord& node) const { return stack_->grid(top()).tree().getValue(node); }

 private:
  const LevelStack* stack_;
  int from_;
  mutable std::vector<LeafFinder> finders_;  // that they remember where they were does not show
};

}  // namespace argil
