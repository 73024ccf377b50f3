// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "leaf_change.h"
#include "level_stack.h"
#include "place_map.h"
#include "vdb.h"

namespace argil {

using LeafValues = std::array<float, kLeafNodes>;

/// One leaf while an edit is being prepared. An absent leaf is filled from the coarser levels, so
/// that every edit sees a full field.
struct LeafEdit {
  // Not "= default", which would clear the values of every new one: they are always written first.
  LeafEdit() noexcept {}  // NOLINT(modernize-use-equals-default)

  Coord place;
  bool existed = false;    ///< the level had this leaf before the edit
  bool present = true;     ///< it will have it afterwards; true until what is unneeded is dropped
  bool changed = false;    ///< some value differs from before
  bool renew = false;      ///< extend() is to solve every node anew, changed or not
  NodeRows changed_nodes;  ///< where changed: these
  LeafValues before;       ///< clamped to the level's band
  LeafValues now;          ///< clamped to the level's band
  std::bitset<kLeafNodes> restricted;  ///< nodes that the finer level decides
  std::unique_ptr<LeafValues> solved;  ///< used within extend() only
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
  /// Copies or fills the leaves at `places` (no repeats), in parallel. `coarser`, when
  /// given, is the unchanged edit of the next coarser level: absent leaves are then filled from it,
  /// which is faster than from the stack and gives the same values.
  LevelEdit(const LevelStack& stack, EditMemory& memory, int level,
            const std::vector<Coord>& places, const LevelEdit* coarser = nullptr);
  ~LevelEdit() { memory_.give(std::move(leaves_)); }
  LevelEdit(const LevelEdit&) = delete;
  LevelEdit& operator=(const LevelEdit&) = delete;

  int level() const noexcept { return level_; }
  double voxel_mm() const noexcept { return stack_.voxel_mm(level_); }
  float band_mm() const noexcept { return stack_.band_mm(level_); }
  const LevelStack& stack() const noexcept { return stack_; }

  std::vector<LeafEdit>& leaves() noexcept { return leaves_; }
  const std::vector<LeafEdit>& leaves() const noexcept { return leaves_; }
  LeafEdit* find(const Coord& place);
  const LeafEdit* find(const Coord& place) const;

  /// The value at any node after the edit, where absent leaves are filled from the coarser levels.
  float now(const Coord& node) const;

  /// Values of a leaf after the edit, or nullptr where the level will have no leaf.
  const float* values_now(const Coord& place) const;
  bool present_now(const Coord& place) const { return values_now(place) != nullptr; }

  /// Copies the nodes of `box` after the edit into `out` (z fastest, clamped to the band); places
  /// without a leaf are filled from the coarser levels as they were before the edit.
  void gather_now(const openvdb::CoordBBox& box, std::vector<float>& out) const;

  /// Sets `changed` and `changed_nodes` of every leaf by comparing its values.
  void mark_changes();

 private:
  const LevelStack& stack_;
  EditMemory& memory_;
  int level_;
  std::vector<LeafEdit> leaves_;
  PlaceMap<std::uint32_t> index_;  ///< one more than the place in leaves_
};

/// Calls `work(n)` for n below `count`, on several threads where that is worth waking them.
template <class Work>
void for_each_leaf(std::size_t count, const Work& work) {
  constexpr std::size_t kGrain = 8;
  if (count < 2 * kGrain) {
    for (std::size_t n = 0; n < count; ++n) work(n);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) work(n);
                    });
}

/// The 5^3 nodes of the next coarser level that span a leaf place, x slowest.
using CoarseNodes = std::array<float, 125>;

/// They as `coarser` (the level above) holds them, interpolated where it has no leaf.
CoarseNodes coarse_nodes(const LevelStack& stack, int coarser, const Coord& place);
/// The same after an edit of that level.
CoarseNodes coarse_nodes(const LevelEdit& coarser, const Coord& place);

/// The 8^3 nodes of the place that they span: odd nodes average their coarse neighbours pairwise,
/// one axis after the other.
void upsample(const CoarseNodes& coarse, LeafValues& out);

/// The 8^3 values of a place of `level` that has no leaf: interpolated from the coarser levels and
/// clamped to the band of `level`.
void prolong_leaf(const LevelStack& stack, int level, const Coord& place, LeafValues& out);

/// Copies what a leaf's values and the node box have in common to `out`, the box's nodes, z
/// fastest.
void copy_into_box(const Coord& place, const float* values, const openvdb::CoordBBox& box,
                   std::vector<float>& out);

/// Calls `visit(place)` for every leaf place that meets the node box.
template <class Visit>
void for_each_place(const openvdb::CoordBBox& nodes, Visit&& visit) {
  const Coord lo = place_of(nodes.min());
  const Coord hi = place_of(nodes.max());
  for (int x = lo.x(); x <= hi.x(); x += kLeafSide) {
    for (int y = lo.y(); y <= hi.y(); y += kLeafSide) {
      for (int z = lo.z(); z <= hi.z(); z += kLeafSide) visit(Coord(x, y, z));
    }
  }
}

}  // namespace argil
