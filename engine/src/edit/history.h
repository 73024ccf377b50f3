// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "argil/engine/clay_options.h"

#include "edit/level_edit.h"
#include "field/mask.h"

namespace argil {

/// A leaf as it was before a change, enough to put it back bit for bit.
struct SavedLeaf {
  float tile = 0.0F;                   ///< the constant value there when there was no leaf
  std::unique_ptr<LeafValues> values;  ///< null when there was no leaf

  /// A copy; `at` null where there was no leaf.
  SavedLeaf(const float* at, float constant);
};

/// One undo step: every leaf the stroke touched, as it was before.
using UndoStep = std::map<std::pair<int, Coord>, SavedLeaf>;

/// Those leaves.
std::vector<std::pair<int, Coord>> keys_of(const UndoStep& step);

/// The undo step of what replaced all levels.
struct FormerLevels {
  std::unique_ptr<LevelStack> levels;
  ClayOptions options;
};

/// The undo step of a stroke that painted the mask: every leaf of it touched, as it was before.
using MaskStep = std::map<Coord, SavedLeaf>;

/// The undo step of what changed the mask as a whole; null for none.
struct FormerMask {
  std::shared_ptr<Mask> mask;
};

using UndoEntry = std::variant<UndoStep, FormerLevels, MaskStep, FormerMask>;

/// Bytes of the leaves of all levels from `finest` on, and of the mask.
std::int64_t leaf_bytes(const LevelStack& stack, int finest = 0);
std::int64_t mask_bytes(const LevelStack& stack);

/// What can be taken back and repeated, within a budget of bytes.
class History {
 public:
  /// Room for one step more. What takes memory is done here, before anything changes that the step
  /// would have to know of: push(), undone() and redone() need it, and cannot fail then.
  void make_room();

  /// A new step; what could be repeated no longer can.
  void push(UndoEntry entry) noexcept;

  bool has_undo() const noexcept { return !undo_.empty(); }
  bool has_redo() const noexcept { return !redo_.empty(); }
  std::size_t undo_depth() const noexcept { return undo_.size(); }

  /// The step that comes next, to be applied, and then to be replaced by its inverse on the other
  /// side.
  UndoEntry& next_undo() noexcept {
    assert(has_undo());
    return undo_.back().entry;
  }
  UndoEntry& next_redo() noexcept {
    assert(has_redo());
    return redo_.back().entry;
  }
  void undone(UndoEntry inverse) noexcept { move_last(undo_, redo_, std::move(inverse)); }
  void redone(UndoEntry inverse) noexcept { move_last(redo_, undo_, std::move(inverse)); }

  /// Forgets the oldest steps to undo, then the farthest to redo, until the rest fits; the last
  /// step stays.
  void trim(std::int64_t budget);

  std::int64_t bytes() const noexcept { return bytes_; }
  std::int64_t forgotten() const noexcept { return forgotten_; }

 private:
  struct Step {
    UndoEntry entry;
    std::int64_t bytes;
  };
  using Steps = std::vector<Step>;
  static Step weighed(UndoEntry entry) noexcept;
  void move_last(Steps& from, Steps& to, UndoEntry inverse) noexcept;

  Steps undo_;
  Steps redo_;
  std::int64_t bytes_ = 0;
  std::int64_t forgotten_ = 0;
};

}  // namespace argil
