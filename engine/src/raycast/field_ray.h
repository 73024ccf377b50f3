// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "field/leaf_finder.h"
#include "field/level_stack.h"
#include "raycast/ray_walk.h"

namespace argil {

/// The values at the corners of the cells of one leaf after another: LevelStack::node_value, bit
/// for bit, with leaves looked up once. Valid while nobody writes the stack, which must be nested.
///
/// Cost  where the one before was: 1 ns a level, 5 ns the corners of a cell within a leaf, 20 ns of
///       one that reaches into the next.
class LeafCells {
 public:
  explicit LeafCells(const LevelStack& stack);

  /// The finest level that has a leaf around this cell of level 0; -1 where none has.
  int finest_level(const Coord& cell);

  /// The leaf of `level` around this cell of level 0, which must be present.
  void open(int level, const Coord& cell);

  /// The corners of a cell of the open leaf that no finer leaf covers: corner 4 i + 2 j + k lies
  /// i, j, k nodes above the low one.
  std::array<float, 8> corners(const Coord& cell);

  /// The nodes of an octant of the open leaf that no finer leaf covers and those next to it: node
  /// (i, j, k) from its low corner on, 0 to 4 each, is number 25 i + 5 j + k.
  void octant(const Coord& low, std::array<float, 125>& values);

 private:
  /// As sampling.h asks for leaves.
  struct Found;
  const VdbLeaf* leaf(int level, const Coord& node) {
    return finders_[static_cast<std::size_t>(level)].leaf(node);
  }
  int look_up_level(const Coord& cell);
  const float* values_beyond(const Coord& relative);
  bool is_finer(const Coord& relative);
  float value(const Coord& relative);
  float stored(const Coord& relative);

  const LevelStack& stack_;
  std::vector<LeafFinder> finders_;
  /// The cells of level 0 that were asked for last and those around them of the same level.
  Coord region_low_;
  int region_side_ = 0;  ///< 0: none was
  int region_level_ = -1;
  int level_ = -1;
  Coord leaf_origin_;
  std::array<const float*, 8> leaves_{};  ///< this one and those 8 nodes on along each axis
  std::uint8_t leaves_known_ = 0;
  std::uint32_t finer_ = 0;  ///< by octant, 0 to 2 along each axis: the finer level has it
  std::uint32_t finer_known_ = 0;
};

/// Where a ray enters or leaves the clay.
struct FieldEntry {
  double along = 0.0;  ///< distance from the origin in voxels of level 0
  int level = 0;       ///< of the cell
};

/// The first point at or after the origin where the field of Clay::distance_at goes from outside
/// (>= 0) to inside along the ray. `origin` in voxels of level 0, `direction` of unit length.
///
/// Looks at every cell the ray meets, from one to the next, so that nothing is missed however thin,
/// and solves the cubic that trilinear values are along a line. Where levels meet the field may
/// jump across zero; then the point is that of the jump.
std::optional<FieldEntry> first_entry(const LevelStack& stack, const Vec3& origin,
                                      const Vec3& direction);

/// Where rays leave the clay: the first point at or after the origin where the field goes from
/// inside (< 0) to outside, which is the far side of the solid that the ray begins in or, when it
/// begins outside, enters first. Valid while nobody writes the stack; thread-safe.
class FieldExits {
 public:
  explicit FieldExits(const LevelStack& stack);
  std::optional<FieldEntry> first(const Vec3& origin, const Vec3& direction) const;

 private:
  const LevelStack& stack_;
  std::optional<CellBox> extent_;  ///< which takes longer to find than a short ray through clay
};

}  // namespace argil
