// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "display_choice.h"
#include "leaf_values.h"

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

  /// As LevelStack::sample and LevelStack::node_value.
  float sample(int level, const Coord& node) const {
    if (choice_ == nullptr) return stack_->sample(level, node);
    const auto leaf_at = [this](int l, const Coord& n) { return leaf(l, n); };
    return sample_of(*stack_, leaf_at, level, node);
  }
  float node_value(int level, const Coord& node) const {
    if (choice_ == nullptr) return stack_->node_value(level, node);
    const auto leaf_at = [this](int l, const Coord& n) { return leaf(l, n); };
    return node_value_of(*stack_, leaf_at, level, node);
  }

  friend bool operator==(const ShownLeaves&, const ShownLeaves&) noexcept = default;

 private:
  const LevelStack* stack_;
  const DisplayChoice* choice_;
};

}  // namespace argil
