// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/vec3.h"

#include "field/leaf.h"

namespace argil {

/// The spacing of a mask in finest voxels: its nodes are those of level 1, so that nodes of all
/// levels but the finest are its own.
inline constexpr int kMaskVoxels = 2;

/// How firmly matter is masked, 0 (free) to 1 (does not move), in space, beside the levels.
/// Trilinear between nodes at multiples of `voxel_mm`. Leaves (8^3 nodes) that differ from the
/// value everywhere else are kept, one number for those of one value. Values are multiples of
/// 2^-20, so that 1 - (1 - m) is m.
///
/// Threads  reading from any while nobody writes.
class Mask {
 public:
  Mask(double voxel_mm, float elsewhere);

  /// A copy that shares nothing.
  std::shared_ptr<Mask> copy() const;

  double voxel_mm() const noexcept { return voxel_mm_; }
  float elsewhere() const { return grid_->background(); }
  bool is_nothing() const { return count_ == 0 && elsewhere() == 0.0F; }
  /// Of the values kept.
  std::int64_t bytes() const;

  /// The values of a leaf; null where it has one value, which then is constant().
  const float* leaf(const Coord& origin) const;
  float constant(const Coord& origin) const { return grid_->tree().getValue(origin); }

  /// Values are rounded to multiples of 2^-20 and must be 0 to 1.
  void put(const Coord& origin, const LeafValues& values);
  void put(const Coord& origin, float value);

  /// What is kept, in lexicographic order.
  std::vector<Coord> sorted_origins() const;

  /// Appends the nodes of a box, z fastest.
  void read(const openvdb::CoordBBox& nodes, std::vector<float>& out) const;

  double at(const Vec3& point_mm) const;

  /// The mask at the nodes of a leaf of a level. False, and `out` is not set, where all are 0.
  bool at_nodes(int level, const Coord& origin, LeafValues& out) const;

  /// Whether the mask is 0 in all of a box.
  bool is_zero_in(const Box3& box_mm) const;

  /// The steepest rise in any direction, per mm, among the kept leaves of more than one value that
  /// meet the box.
  double slope_in(const Box3& box_mm) const;

  /// The leaves that meet the box where neighbouring nodes rise by more than that.
  std::vector<Coord> steep_leaves(const Box3& box_mm, double slope_per_mm) const;

  /// xxh64 of all there is.
  std::uint64_t hash() const;

  /// For files: kept leaves are active.
  const VdbGrid& grid() const noexcept { return *grid_; }

 private:
  bool is_kept(const Coord& origin) const;

  double voxel_mm_;
  VdbGrid::Ptr grid_;
  std::int64_t count_ = 0;  ///< kept leaves
};

/// The same mask on nodes of another spacing.
std::shared_ptr<Mask> resampled(const Mask& from, double voxel_mm);

/// Every 2^steps-th node of a mask.
std::shared_ptr<Mask> coarsened(const Mask& from, int steps);

/// Why a grid read from a file is no mask of this spacing, or null when it is one.
const char* fault_of_mask(const VdbGrid& grid, double voxel_mm);
/// A grid without fault as a mask.
std::shared_ptr<Mask> mask_of(const VdbGrid& grid, double voxel_mm);

}  // namespace argil
