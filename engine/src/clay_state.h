// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "argil/engine/clay.h"

#include "edit.h"
#include "leaf_change.h"
#include "level_stack.h"

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

/// A stroke between its begin and its end.
struct OpenStroke {
  Tool tool;
  double spacing = 0.0;
  DabFeeder feeder;
  UndoStep step;
  StrokeReport report;
};

struct Clay::State {
  State(std::unique_ptr<LevelStack> stack, const ClayOptions& clay_options);

  double tolerance_mm() const { return options.tolerance_voxels * options.voxel_mm; }

  void log_change(const LeafChange& change);

  /// Forgets the oldest steps while undo and redo hold more than `undo_limit` bytes.
  void trim_undo();

  /// Puts the leaves of a step back; `exchange` also returns the step that undoes that.
  void restore(const UndoStep& step);
  UndoStep exchange(const UndoStep& step);

  /// The parts of a stroke, once their input was found good. `apply_dabs` false: `progress` asked
  /// to stop. All may throw bad_alloc with the stroke half done: take_back() then.
  void open_stroke(const Tool& tool, double spacing, const Mirror& mirror);
  bool apply_dabs(const std::vector<DabPose>& dabs, const Progress& progress);
  StrokeReport close_stroke();
  void take_back();

  ClayOptions options;
  std::unique_ptr<LevelStack> levels;
  std::optional<OpenStroke> open;
  std::deque<UndoStep> undo;
  std::vector<UndoStep> redo;
  std::int64_t undo_limit = std::numeric_limits<std::int64_t>::max();
  std::uint64_t identity = 0;
  std::uint64_t forgotten = 0;  ///< changes no longer in the log
  std::vector<LeafChange> changes;

 private:
  EditTarget target_of_open_stroke();
  EditMemory memory;
};

/// The error when there is no memory to do `what`.
Error out_of_memory(const char* what);

}  // namespace argil
