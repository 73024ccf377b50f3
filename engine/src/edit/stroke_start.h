// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/history.h"
#include "field/level_stack.h"

namespace argil {

/// The levels as a stroke found them, whatever it did since: what it changed, from its undo step,
/// all else from the stack. Nothing is copied; both have to stay as they are while this is asked.
/// For several threads.
class StrokeStart {
 public:
  StrokeStart(const LevelStack& stack, const UndoStep& step) : stack_(stack), step_(step) {}

  int top() const noexcept { return stack_.top(); }
  /// Of the leaf that holds a node; null where the level had none.
  const float* values(int level, const Coord& node) const;
  /// Of the coarsest level, where it had no leaf.
  float constant(const Coord& node) const;
  /// As LevelStack::sample.
  float sample(int level, const Coord& node) const;
  /// The values of a leaf, stored or not, within the band of its level.
  void read(int level, const Coord& origin, LeafValues& out) const;

 private:
  const SavedLeaf* saved(int level, const Coord& node) const;

  const LevelStack& stack_;
  const UndoStep& step_;
};

}  // namespace argil
