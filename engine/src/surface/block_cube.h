// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "argil/engine/display_block.h"

#include "field/leaf_change.h"
#include "rows/rows.h"
#include "surface/drawn_block.h"

namespace argil {

/// Where a ray meets drawn blocks first, from the front.
struct BlockHit {
  double along = std::numeric_limits<double>::infinity();
  BlockId block;
  int triangle = 0;
  Vec3 normal;  ///< unit, between those of the triangle's corners; zero where they cancel out
  bool has_failed = false;  ///< no memory: some block was not looked at
};

/// A cube's box, widened, around all leaves, there or not.
struct CubeBox {
  std::array<float, 3> low;
  std::array<float, 3> high;
};

/// Memory that tests of triangles need, kept from one ray to the next.
class RayScratch {
 public:
  /// For blocks of so many vertices. False: no memory.
  bool reserve(std::size_t vertices) noexcept;
  float* x() noexcept { return x_.data(); }
  float* y() noexcept { return y_.data(); }
  unsigned char* sides() noexcept { return sides_.data(); }

 private:
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<unsigned char> sides_;
};

/// The drawn blocks of one level in a cube of 8^3 leaves, 64 nodes along each axis, and their
/// boxes. Refers to the blocks.
///
/// Threads  one; a ray makes boxes tighter.
class BlockCube {
 public:
  static constexpr int kLeaves = 8;  ///< along each axis
  static constexpr int kMost = kLeaves * kLeaves * kLeaves;

  /// Vertices of a leaf's block lie in the leaf's cells or no farther from them, in voxels.
  static constexpr double kAround = CutJob::kMostStep;
  /// Boxes are this much larger than what is in them, in voxels of the level: what rounding could
  /// move a ray by, up to 50 000 voxels from where it begins, with room to spare.
  static constexpr double kWidenVoxels = 0.02;

  /// The cube that a block belongs to.
  static LeafKey key_of(const BlockId& block) noexcept;

  /// `voxel_mm` of level 0.
  BlockCube(const LeafKey& key, double voxel_mm);

  /// A block has other bits. False: it is not there.
  bool refresh(const BlockId& id) noexcept;
  /// Puts in a block that is not there. It must have triangles.
  void insert(const BlockId& id, const DrawnBlock& block);
  /// Takes a block out. False: it is not there.
  bool erase(const BlockId& id) noexcept;

  const LeafKey& key() const noexcept { return key_; }
  bool is_empty() const noexcept { return slots_.empty(); }
  int count() const noexcept { return static_cast<int>(slots_.size()); }
  std::int64_t bytes() const noexcept;
  CubeBox box() const noexcept;

  /// Lowers the hit to what the ray meets in the cube. Of triangles as near as each other that of
  /// the lowest block and number counts, whatever came first. Says whether the hit changed.
  bool meet(const RayJob& ray, RayScratch& scratch, BlockHit& hit) noexcept;

 private:
  struct Slot {
    BlockId id;
    const DrawnBlock* block;
    bool is_loose;  ///< the box is the leaf's, and not yet that of the triangles
  };
  using Entries = std::array<BoxEntry, kMost + 1>;

  static std::size_t place_of(const BlockId& id) noexcept;
  void loosen(std::size_t slot) noexcept;
  void set_box(std::size_t slot, const std::array<float, 3>& low,
               const std::array<float, 3>& high) noexcept;
  bool tighten(const Entries& entries, int count) noexcept;
  void tighten(std::size_t slot) noexcept;
  bool meet(const Slot& slot, const RayJob& ray, RayScratch& scratch, BlockHit& hit) const noexcept;

  LeafKey key_;
  double voxel_mm_;  ///< of the level
  float widen_mm_;
  std::vector<Slot> slots_;
  std::vector<EightBoxes> boxes_;             ///< of the slots, in their order
  std::array<std::uint16_t, kMost> slot_of_;  ///< by place in the cube: one more, 0 for none
};

}  // namespace argil
