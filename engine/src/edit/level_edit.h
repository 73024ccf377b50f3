// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "field/leaf_change.h"
#include "field/leaf_finder.h"
#include "field/leaf_map.h"
#include "field/level_stack.h"
#include "field/prolongation.h"

namespace argil {

/// Memory of earlier edits: pages from the system, cleared, cost a small dab as much as its work.
/// Keeps 64 MB at most. For several threads.
class EditMemory {
 public:
  /// Room for the values of so many leaves, not cleared.
  static constexpr std::size_t kLeavesOfChunk = 32;
  using Chunk = std::array<LeafValues, kLeavesOfChunk>;

  std::unique_ptr<Chunk> take();
  void give(std::vector<std::unique_ptr<Chunk>>&& chunks) noexcept;
  void clear() noexcept;

 private:
  static constexpr std::size_t kMostChunks = (std::size_t{64} << 20) / sizeof(Chunk);
  std::mutex mutex_;
  std::vector<std::unique_ptr<Chunk>> kept_;
};

/// Values of leaves for as long as an edit of one level lasts. Several threads may take.
class LeafArena {
 public:
  /// For at most so many.
  LeafArena(EditMemory& memory, std::size_t leaves);
  ~LeafArena() { memory_.give(std::move(chunks_)); }
  LeafArena(const LeafArena&) = delete;
  LeafArena& operator=(const LeafArena&) = delete;

  LeafValues& take() {
    const std::size_t n = used_.fetch_add(1, std::memory_order_relaxed);
    const std::size_t at = n / EditMemory::kLeavesOfChunk;
    assert(at < places_.size());
    EditMemory::Chunk* chunk = places_[at].load(std::memory_order_acquire);
    if (chunk == nullptr) chunk = open(at);
    return (*chunk)[n % EditMemory::kLeavesOfChunk];
  }

 private:
  EditMemory::Chunk* open(std::size_t at);

  EditMemory& memory_;
  std::vector<std::atomic<EditMemory::Chunk*>> places_;  ///< of chunks, null until one is needed
  std::mutex mutex_;
  std::vector<std::unique_ptr<EditMemory::Chunk>> chunks_;
  std::atomic<std::size_t> used_{0};
};

/// One leaf while an edit is being prepared. An absent leaf is filled from the coarser levels, so
/// that every edit sees a full field. Values are clamped to the level's band. Most leaves that an
/// edit looks at it leaves as they are: until the first write they have the stack's values,
/// uncopied.
class LeafEdit {
 public:
  Coord origin;
  bool existed = false;      ///< the level had this leaf before the edit
  bool present = true;       ///< it will have it afterwards; true until pruned
  bool changed = false;      ///< some value differs from before, as far as mark_changes() looked
  bool marked = false;       ///< redistance() is to solve every node of it, changed or not
  NodeRows changed_nodes{};  ///< where changed: these
  NodeRows restricted{};     ///< nodes that the finer level decides

  /// The stack's, or those of `filled` where it has no such leaf. They stay as they are until the
  /// edit is committed; after that before() says nothing.
  void open(const float* stored, const LeafValues* filled, LeafArena& arena) noexcept {
    existed = stored != nullptr;
    before_ = existed ? stored : filled->data();
    now_ = before_;
    arena_ = &arena;
  }
  const float* before() const noexcept { return before_; }
  const float* now() const noexcept { return now_; }
  bool is_written() const noexcept { return now_ != before_; }
  /// To be written: at first a copy of before().
  float* write() {
    if (!is_written()) {
      LeafValues& copy = arena_->take();
      std::copy_n(before_, kLeafNodes, copy.data());
      now_ = copy.data();
    }
    is_marked_ = false;
    return const_cast<float*>(now_);  // NOLINT: the arena's, so not const
  }
  /// The same with all values, where any differs.
  void write_all(const LeafValues& values) {
    if (std::memcmp(values.data(), now_, sizeof values) == 0) return;
    std::copy(values.begin(), values.end(), is_written() ? write() : claim());
  }
  /// Sets `changed` and `changed_nodes`.
  void mark_changes() noexcept;

 private:
  float* claim() {
    LeafValues& own = arena_->take();
    now_ = own.data();
    is_marked_ = false;
    return own.data();
  }

  const float* before_ = nullptr;
  const float* now_ = nullptr;
  LeafArena* arena_ = nullptr;
  bool is_marked_ = true;  ///< nothing was written since mark_changes()
};

/// What an edit is about to do to one level: the leaves it may touch, laid over the unchanged
/// stack. Nobody may write the stack while this lives but Edit::commit, once the whole edit stands,
/// so a failed or refused edit leaves nothing behind.
class LevelEdit {
 public:
  /// Takes in or fills the leaves at `origins` (no repeats, any order), in parallel, with room for
  /// two copies of each: filled and written. `coarser`, when given, is the unchanged edit of the
  /// next coarser level: absent leaves are then filled from it, which is faster than from the stack
  /// and gives the same values.
  LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
            const std::vector<Coord>& origins, const LevelEdit* coarser = nullptr);
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
      if (const LeafEdit* edit = find(origin)) return edit->present ? edit->now() : nullptr;
      return stored_.values(origin);
    }
    bool present_now(const Coord& origin) { return values_now(origin) != nullptr; }
    /// Values of a leaf as they were before the edit, those of the edit filled; else nullptr where
    /// the level has no leaf.
    const float* filled_before(const Coord& origin) {
      if (const LeafEdit* edit = find(origin)) return edit->before();
      return stored_.values(origin);
    }
    /// As values_now(), but of a leaf of the edit also where it will not be present.
    const float* filled_now(const Coord& origin) {
      if (const LeafEdit* edit = find(origin)) return edit->now();
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

  /// Sets `changed` and `changed_nodes` of every leaf that was written, by comparing its values.
  void mark_changes();

 private:
  const LevelStack& stack_;
  int level_;
  LeafArena arena_;
  std::vector<LeafEdit> leaves_;
  LeafMap<std::uint32_t> index_;  ///< one more than the index in leaves_
};

/// As coarse_nodes() of the stack, after an edit of that level.
CoarseNodes coarse_nodes(const LevelEdit& coarser, const Coord& origin);

}  // namespace argil
