// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "leaf_change.h"
#include "level_edit.h"
#include "place_map.h"
#include "restriction.h"
#include "unsettled.h"

namespace argil {

/// Leaves by level and place.
using LeafList = std::vector<std::pair<int, Coord>>;

/// All there are, the finest level first, by place.
LeafList all_leaves(const LevelStack& stack);

/// Told of every leaf right before it changes: the values it has, null when there is no leaf, and
/// then the constant value there.
using LeafSink = std::function<void(const LeafChange& change, const float* values, float tile)>;

/// Told of every place of the mask right before it changes: its values, null when it has one value,
/// and then that.
using MaskSink = std::function<void(const Coord& place, const float* values, float constant)>;

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
  std::int64_t free_bytes;         ///< what the edit may take
  MaskSink mask_sink = {};         ///< for strokes of Action::mask
  Unsettled* unsettled = nullptr;  ///< of the stroke
};

/// One dab or one clean-up over all levels, prepared beside the stack and then written at once.
class Edit {
 public:
  explicit Edit(EditTarget& target);

  /// Wants the leaf place at `level` to take part. Before load().
  void want(int level, const Coord& place);

  /// Adds what balance requires on the coarser levels and copies all leaves. Throws OverLimit when
  /// they take more than the target allows.
  void load();

  LevelEdit& level(int level) { return *levels_[static_cast<std::size_t>(level)]; }
  int count() const noexcept { return stack_.count(); }

  /// Restricts the next finer level of the edit to `level`. Both know their changes, and the finer
  /// one is done: only leaves that drop_empty will keep count. A copy that nothing changed says
  /// only what `level` itself says; averaged back, dab by dab, it would wear thin walls away.
  void restrict_to(int level, RestrictedLeaves which);

  /// Takes leaves out that hold nothing or that the coarser level stands for well enough.
  void drop_unneeded();

  /// Takes leaves out that hold nothing, and does not make those that nothing changed or needs.
  /// What the coarser level could stand for stays: dropped now and refined again by the next dab,
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
  std::vector<PlaceMap<std::uint8_t>> wanted_;  ///< 1: takes part
  std::vector<std::unique_ptr<LevelEdit>> levels_;
};

/// The finest level whose voxels a tool of this smallest radius still needs: 8 or more voxels
/// across the radius, within the levels there are.
int level_of_tool(const LevelStack& stack, double smallest_radius_mm);

/// Solves anew the leaves among `touched` (level, place) where |grad phi| strayed from [0.5, 2].
/// False when there were none. What is solved may no longer fit its neighbours: call again with
/// them.
bool renormalise_strayed(EditTarget& target, const LeafList& touched);

/// Drops the leaves among and under the `touched` ones (level, place) that are not needed, or that
/// a change of the coarser level, or a drop next door, left unneeded. False when no leaf came or
/// went.
bool tidy(EditTarget& target, const LeafList& touched);

/// The upwind |grad phi| of a node that has no neighbour of the other sign, from its value and its
/// six neighbours' values: 1 for a distance, also on its ridges and valleys.
float upwind_gradient(float here, const std::array<float, 6>& around, float voxel);

/// True when some node that the level itself decides strays from [0.5, 2]: within 3 voxels of the
/// surface, the level ends neither at it nor at its six neighbours, which are on the same side, and
/// no finer cell meets it.
bool strays(const LevelStack& stack, int level, const Coord& place, Coord* where = nullptr);

}  // namespace argil
