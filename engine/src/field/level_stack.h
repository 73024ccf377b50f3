// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

#include "argil/engine/clay_options.h"

#include "field/leaf.h"
#include "field/vdb.h"

namespace argil {

// Notation: a node of level L has integer coordinates and lies at coordinate * h_L. Node i of level
// L+1 is node 2i of level L. A leaf holds 8^3 nodes, origin a multiple of 8; it also stands for the
// 8^3 cells whose lowest corner is one of its nodes. A leaf of level L covers one octant (4^3
// cells) of its parent at L+1.

/// From 0.05 mm to 400 m. Origins of the coarsest, seen as nodes of the finest, stay within int32.
inline constexpr int kMostLevels = 24;

class Mask;

/// The levels of a clay and how a value is found among them. Reading is thread-safe while nobody
/// writes.
class LevelStack {
 public:
  /// `levels` empty levels, level 0 with voxel size `finest_voxel_mm`, everything outside.
  LevelStack(double finest_voxel_mm, int levels);

  /// The levels from `finest` on as a stack of their own, which shares nothing. No mask.
  std::unique_ptr<LevelStack> copy_from(int finest) const;

  int count() const noexcept { return static_cast<int>(grids_.size()); }
  int top() const noexcept { return count() - 1; }
  bool is_level(int level) const noexcept { return level >= 0 && level < count(); }
  double voxel_mm(int level) const noexcept {
    assert(is_level(level));
    return voxel_mm_[static_cast<std::size_t>(level)];
  }
  /// The stored value outside the band: kHalfWidthVoxels * h_L.
  float band_mm(int level) const noexcept {
    return static_cast<float>(kHalfWidthVoxels * voxel_mm(level));
  }

  VdbGrid& grid(int level) noexcept {
    assert(is_level(level));
    return *grids_[static_cast<std::size_t>(level)];
  }
  const VdbGrid& grid(int level) const noexcept {
    assert(is_level(level));
    return *grids_[static_cast<std::size_t>(level)];
  }

  /// The leaf holding `node`, or nullptr where the level has none. (A hash lookup and two array
  /// steps: about 20 ns; fetch once per leaf, not per node.)
  const VdbLeaf* leaf(int level, const Coord& node) const {
    return grid(level).tree().probeConstLeaf(node);
  }
  bool has_leaf(int level, const Coord& node) const { return leaf(level, node) != nullptr; }

  /// Writes a leaf's 8^3 values, making the leaf when absent; nodes within the band become active.
  void set_leaf(int level, const Coord& origin, const float* values);
  /// The same for a leaf that is there. Several threads may write different leaves.
  void rewrite_leaf(int level, const Coord& origin, const float* values);
  /// As rewrite_leaf; `values` become what the leaf had.
  void swap_leaf(int level, const Coord& origin, LeafValues& values);
  /// Puts a constant inactive tile where a leaf may have been.
  void erase_leaf(int level, const Coord& origin, float tile);

  /// Leaf origins of a level in lexicographic order.
  std::vector<Coord> sorted_origins(int level) const;

  /// The value at a node of `level`, ignoring finer levels: stored where a leaf is present, else
  /// interpolated (trilinear, so 1, 2, 4 or 8 nodes) in the next coarser level that has a leaf
  /// there; at the coarsest level the constant tile. Not clamped to the level's own band.
  float sample(int level, const Coord& node) const;

  /// What the coarser levels say of a node of `level`, below the top, whether it is stored or not.
  float sample_above(int level, const Coord& node) const;

  /// The value of the field at a node of `level`: stored at the finest level that has a leaf there,
  /// else as `sample`. This is what the surface is made of.
  float node_value(int level, const Coord& node) const;

  /// What is masked (mask.h); null where nothing is, which costs edits nothing.
  const Mask* mask() const noexcept { return mask_.get(); }
  /// Makes one of nothing when there is none.
  Mask& mask_to_change();
  /// Replaces it by one that masks something, or by null, and returns the former.
  std::shared_ptr<Mask> exchange_mask(std::shared_ptr<Mask> by) noexcept;
  void drop_mask_of_nothing() noexcept;

 private:
  void write(VdbLeaf& leaf, int level, const float* values);
  void set_active(VdbLeaf& leaf, int level);

  std::vector<VdbGrid::Ptr> grids_;
  std::vector<double> voxel_mm_;
  std::shared_ptr<Mask> mask_;
};

}  // namespace argil
