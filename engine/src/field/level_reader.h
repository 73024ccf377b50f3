// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "field/dense_block.h"
#include "field/leaf_finder.h"
#include "field/level_stack.h"
#include "field/resample.h"

namespace argil {

/// What is read of a node depends on nodes of a coarser level at most so many of them away: the
/// four on a side of the octant that the leaf covers, and those that taps reach over all levels
/// between.
inline constexpr int kReadReach = 6;

/// Reads blocks of one level at a time, ignoring finer ones. What it found and the memory it took
/// are kept for the next block: to be used by one thread, and not after leaves came or went.
class LevelReader {
 public:
  explicit LevelReader(const LevelStack& stack);

  const LevelStack& stack() const noexcept { return *stack_; }

  /// What is known of the values that were read.
  struct Reading {
    int coarsest = 0;     ///< the coarsest level that was read
    bool is_far = false;  ///< all are the band's bounds, and on one side
  };

  /// The nodes `box` of `level`, z fastest. What the level does not store is interpolated from the
  /// finest coarser level that has a leaf there, with four taps along each axis: two, as the
  /// surface has, lie inside every curve, by up to the clay's tolerance. Where no level has any, or
  /// the coarser level knows nothing near enough to be asked for, it is the bound of the band.
  Reading read(int level, const NodeBox& box, std::span<float> out);

  /// As LevelStack::leaf.
  const VdbLeaf* leaf(int level, const Coord& node) {
    return finders_[static_cast<std::size_t>(level)].leaf(node);
  }

  /// Of a leaf, without reading it: far when the level does not store it and the leaf of the coarser
  /// level that has it tells that no node is near the surface. Then it reads as far, too.
  Reading look(int level, const Coord& origin);

 private:
  /// Memory of the blocks that are read for one level's sake.
  struct Scratch {
    std::vector<float> coarse;
    std::vector<float> fine;
    ResampleScratch resample;
  };

  Reading read_part(int level, const NodeBox& box, const NodeBox& part, std::span<float> out);
  Reading interpolate(int level, const NodeBox& box, const NodeBox& part, std::span<float> out);
  int level_above(int level, const Coord& node);
  bool is_far_above(int level, int above, const Coord& origin);
  float far_value(int level, const Coord& origin) const;

  const LevelStack* stack_;
  std::vector<LeafFinder> finders_;
  std::vector<Scratch> scratch_;  ///< by level
};

}  // namespace argil
