// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "edit/history.h"
#include "edit/level_edit.h"
#include "edit/restriction.h"
#include "field/leaf_change.h"
#include "field/leaf_map.h"

namespace argil {

class RedistanceQueue;

/// Leaves by level and origin.
using LeafList = std::vector<std::pair<int, Coord>>;

/// All there are, the finest level first, by origin.
LeafList all_leaves(const LevelStack& stack);

/// Told of every leaf right before it changes: the values it has, null when there is no leaf, and
/// then the constant value there.
using LeafSink = std::function<void(const LeafChange& change, const float* values, float tile)>;

/// Told of every leaf of the mask right before it changes: its values, null when it has one value,
/// and then that.
using MaskSink = std::function<void(const Coord& origin, const float* values, float constant)>;

/// An edit that would take more than the clay's limits allow.
struct OverLimit : std::bad_alloc {
  explicit OverLimit(std::int64_t bytes) noexcept : needed(bytes) {}
  std::int64_t needed;
};

/// The clay that edits write to.
struct EditTarget {
  LevelStack& stack;
  EditMemory& memory;
  double tolerance_mm;
  LeafSink sink;
  std::int64_t free_bytes;                      ///< what the edit may take
  MaskSink mask_sink = {};                      ///< for strokes that paint the mask
  RedistanceQueue* redistance_queue = nullptr;  ///< of the stroke
  const UndoStep* stroke_step = nullptr;        ///< likewise: its leaves as it found them
  std::optional<double> edge_radius_mm = {};    ///< as ClayOptions have it
};

/// The same target; leaves that change are also appended to `changed`, with repeats.
EditTarget noting(const EditTarget& target, LeafList& changed);

/// One dab or one clean-up over all levels, prepared beside the stack and then written at once.
class Edit {
 public:
  explicit Edit(EditTarget& target);

  /// Wants the leaf of `level`, stored or not, to take part. Before load().
  void want(int level, const Coord& origin);

  /// Adds what balance requires on the coarser levels and takes in all leaves. Throws OverLimit
  /// when they take more than the target allows.
  void load();

  LevelEdit& level(int level) {
    assert(!levels_.empty() && stack_.is_level(level));
    return *levels_[static_cast<std::size_t>(level)];
  }
  int count() const noexcept { return stack_.count(); }

  /// Restricts the next finer level of the edit to `level`. Both know their changes, and the finer
  /// one is done: only leaves that drop_empty will keep count. A copy that nothing changed says
  /// only what `level` itself says; averaged back, dab by dab, it would wear thin walls away.
  void restrict_to(int level, RestrictedLeaves which);

  /// Takes leaves out that hold nothing or that the coarser level describes as well (prune.h).
  void prune();

  /// Takes leaves out that hold nothing, and does not make those that nothing changed or needs.
  /// What the coarser level could describe stays: dropped now and refined again by the next dab,
  /// it would lose what that dab did, and curved surfaces would wear down (StrokeSpacing.*).
  void drop_empty();

  /// Writes the leaves that differ. The target's sink hears of each first. True when some
  /// came or went.
  bool commit();

 private:
  enum class Fate { kept, rewritten, made, erased };
  Fate fate_of(int level, const LeafEdit& leaf) const;
  bool has_child(int level, const LeafEdit& leaf);
  bool stays(int level, const LeafEdit& leaf);
  bool is_filled(int level, const LeafEdit& leaf);
  void drop_empty_of(int level);

  EditTarget& target_;
  LevelStack& stack_;
  std::vector<LeafMap<std::uint8_t>> wanted_;  ///< 1: takes part
  std::vector<std::unique_ptr<LevelEdit>> levels_;
};

}  // namespace argil
