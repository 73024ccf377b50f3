// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <vector>

#include "field/leaf_change.h"
#include "field/leaf_finder.h"
#include "field/leaf_map.h"
#include "field/level_stack.h"
#include "field/prolongation.h"

namespace argil {

/// One leaf while an edit is being prepared. An absent leaf is filled from the coarser levels, so
/// that every edit sees a full field.
struct LeafEdit {
  // Not "= default", which would clear the values of every new one: they are always written first.
  LeafEdit() noexcept {}  // NOLINT(modernize-use-equals-default)

  Coord origin;
  bool existed = false;    ///< the level had this leaf before the edit
  bool present = true;     ///< it will have it afterwards; true until pruned
  bool changed = false;    ///< some value differs from before
  bool marked = false;     ///< redistance() is to solve every node of it, changed or not
  NodeRows changed_nodes;  ///< where changed: these
  LeafValues before;       ///< clamped to the level's band
  LeafValues now;          ///< clamped to the level's band
  std::bitset<kLeafNodes> restricted;  ///< nodes that the finer level decides
  std::unique_ptr<LeafValues> solved;  ///< used within redistance() only
};

/// Memory of earlier edits: pages from the system, cleared, cost a small dab as much as its work.
/// Keeps 64 MB at most.
class EditMemory {
 public:
  EditMemory() { kept_.reserve(kMostKept); }
  std::vector<LeafEdit> take(std::size_t count);
  void give(std::vector<LeafEdit>&& leaves) noexcept;

 private:
  static constexpr std::size_t kMostKept = 64;  ///< more than a clay has levels
  std::vector<std::vector<LeafEdit>> kept_;
  std::size_t leaves_ = 0;  ///< that the kept ones have room for
};

/// What an edit is about to do to one level: copies of the leaves it may touch, laid over the
/// unchanged stack. The stack is written only when the whole edit stands (Edit::commit), so a
/// failed or refused edit leaves nothing behind.
class LevelEdit {
 public:
  /// Copies or fills the leaves at `origins` (no repeats, any order), in parallel. `coarser`, when
  /// given, is the unchanged edit of the next coarser level: absent leaves are then filled from it,
  /// which is faster than from the stack and gives the same values.
  LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
            const std::vector<Coord>& origins, const LevelEdit* coarser = nullptr);
  ~LevelEdit() { memory_.give(std::move(leaves_)); }
  LevelEdit(const LevelEdit&) = delete;
  LevelEdit& operator=(const LevelEdit&) = delete;

  int level() const noexcept { return level_; }
  double voxel_mm() const noexcept { return stack_.voxel_mm(level_); }
  float band_mm() const noexcept { return stack_.band_mm(level_); }
  const LevelStack& stack() const noexcept { return stack_; }

  std::vector<LeafEdit>& leaves() noexcept { return leaves_; }
  const std::vector<LeafEdit>& leaves() const noexcept { return leaves_; }
  LeafEdit* find(const Coord& origin);
  const LeafEdit* find(const Coord& origin) const;

  /// The value at any node after the edit, where absent leaves are filled from the coarser levels.
  float now(const Coord& node) const;

  /// Finds leaves for somebody who asks for some that lie together. For one thread.
  class Reader {
   public:
    explicit Reader(const LevelEdit& edit)
        : edit_(edit), index_(edit.index_), stored_(edit.stack_, edit.level_) {}

    const LeafEdit* find(const Coord& origin) {
      const std::uint32_t found = index_.get(origin);
      return found == 0 ? nullptr : &edit_.leaves_[found - 1];
    }
    /// Values of a leaf after the edit, or nullptr where the level will have no leaf.
    const float* values_now(const Coord& origin) {
      if (const LeafEdit* edit = find(origin)) return edit->present ? edit->now.data() : nullptr;
      return stored_.values(origin);
    }
    bool present_now(const Coord& origin) { return values_now(origin) != nullptr; }
    /// The same, but of a leaf of the edit also where it will not be present.
    const float* filled_now(const Coord& origin) {
      if (const LeafEdit* edit = find(origin)) return edit->now.data();
      return stored_.values(origin);
    }

   private:
    const LevelEdit& edit_;
    LeafMap<std::uint32_t>::Reader index_;
    LeafFinder stored_;
  };

  /// Copies the nodes of `box` after the edit into `out` (z fastest, clamped to the band); where
  /// the level has no leaf, from the coarser levels as they were before the edit.
  void gather_now(const openvdb::CoordBBox& box, std::vector<float>& out) const;

  /// Sets `changed` and `changed_nodes` of every leaf by comparing its values.
  void mark_changes();

 private:
  const LevelStack& stack_;
  EditMemory& memory_;
  int level_;
  std::vector<LeafEdit> leaves_;
  LeafMap<std::uint32_t> index_;  ///< one more than the index in leaves_
};

/// As coarse_nodes() of the stack, after an edit of that level.
CoarseNodes coarse_nodes(const LevelEdit& coarser, const Coord& origin);

}  // namespace argil
