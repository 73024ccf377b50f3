// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/sampling.h"
#include "surface/display_choice.h"

namespace argil {

/// The leaves of a stack that a surface is made of: all, or all but those a choice hides, which
/// then count as absent. Refers to both.
class ShownLeaves {
 public:
  ShownLeaves(const LevelStack& stack, const DisplayChoice* choice = nullptr)  // NOLINT: implicit
      : stack_(&stack), choice_(choice) {}

  const LevelStack& stack() const noexcept { return *stack_; }

  /// Of a leaf that is there. `node`: any of its nodes.
  bool shows(int level, const Coord& node) const {
    return choice_ == nullptr || !choice_->hides(level, node);
  }
  const VdbLeaf* leaf(int level, const Coord& node) const {
    const VdbLeaf* found = stack_->leaf(level, node);
    return found != nullptr && shows(level, node) ? found : nullptr;
  }
  bool has_leaf(int level, const Coord& node) const { return leaf(level, node) != nullptr; }

  int top() const noexcept { return stack_->top(); }
  const float* values(int level, const Coord& node) const {
    const VdbLeaf* found = leaf(level, node);
    return found != nullptr ? found->buffer().data() : nullptr;
  }
  float constant(const Coord& node) const { return stack_->grid(top()).tree().getValue(node); }

  /// As LevelStack::sample and LevelStack::node_value.
  float sample(int level, const Coord& node) const {
    return choice_ == nullptr ? stack_->sample(level, node) : sample_of(*this, level, node);
  }
  float node_value(int level, const Coord& node) const {
    return choice_ == nullptr ? stack_->node_value(level, node) : node_value_of(*this, level, node);
  }

  friend bool operator==(const ShownLeaves&, const ShownLeaves&) noexcept = default;

 private:
  const LevelStack* stack_;
  const DisplayChoice* choice_;
};

}  // namespace argil
