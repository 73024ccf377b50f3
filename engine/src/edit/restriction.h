// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "edit/level_edit.h"
#include "field/leaf_change.h"

namespace argil {

/// Where restriction reads its finer level from. One for each thread.
class FineSource {
 public:
  virtual ~FineSource() = default;
  /// Values after the edit of a leaf of the finer level, or nullptr.
  virtual const float* now(const Coord& origin) = 0;
  /// The nodes of that leaf that the edit changed; nullptr when it changed none.
  virtual const NodeRows* changed(const Coord& origin) = 0;
};

/// A level that nobody edits.
class StackSource final : public FineSource {
 public:
  StackSource(const LevelStack& stack, int level) : leaves_(stack, level) {}
  const float* now(const Coord& origin) override { return leaves_.values(origin); }
  const NodeRows* changed(const Coord&) override { return nullptr; }

 private:
  LeafFinder leaves_;
};

/// A value and its two neighbours along an axis, the neighbours with half its weight. A mirror
/// image has the same bits.
inline float weighted(float before, float here, float after) noexcept {
  return 0.5F * here + 0.25F * (before + after);
}

/// A mean of distances whose rounding says nothing: where a flat wall lies on nodes, less than 1e-5
/// voxels would put them on either side by chance.
inline float without_rounding(float mean, float voxel) noexcept {
  return std::abs(mean) < 1e-5F * voxel ? 0.0F : mean;
}

/// The nodes of level L that decide the 8^3 nodes of one leaf of level L+1: a 17^3 block that
/// starts one node below the leaf's origin.
struct FineNeighbourhood {
  static constexpr std::size_t kSide = 17;
  static constexpr std::size_t kRow = 20;  ///< the nodes beyond the block are not used

  /// Along z. NaN where the level has no leaf or the node is outside its band.
  using Row = std::array<float, kRow>;
  std::array<Row, kSide * kSide> rows;
  std::array<std::uint32_t, kSide * kSide> changed;  ///< bit z of the row
  float voxel = 0.0F;
  bool any_present = false;
  bool any_changed = false;
};

/// Gathers the neighbourhood of the coarse leaf at `coarse_origin`, stored or not; where no finer
/// leaf is there (any_present), rows stay as they were.
void gather_fine(FineSource& fine, const Coord& coarse_origin, float fine_band,
                 FineNeighbourhood& out);

/// What a finer level says of a coarse leaf's nodes.
struct Restricted {
  NodeRows decided;   ///< where the fine node at the same point is in the fine band
  NodeRows averaged;  ///< of those: full weighting; else the fine node's own value
  NodeRows changed;   ///< some fine node that has a weight changed in the edit
  LeafValues value;   ///< of those decided
};

/// The restriction of the finer level to the nodes of a coarse leaf: full weighting (the adjoint of
/// trilinear prolongation) where all 27 fine nodes around are in the fine band, else the value of
/// the fine node at the same point. Mirror images of fine nodes give the mirror image in every bit.
void restrict_leaf(const FineNeighbourhood& fine, Restricted& out);

/// A coarse value may differ from the restriction of the finer level by this fraction of a fine
/// voxel: leaves that were refined and not edited since are not restricted again.
inline constexpr float kRestrictionTolerance = 0.5F;

/// Which leaves are looked at.
enum class RestrictedLeaves {
  all,     ///< also those that only need their flags: redistance() wants them
  touched  ///< those that the edit changed, here or in the finer level
};

/// Flags the nodes of `coarse` that the finer level decides, and overwrites those whose restriction
/// the edit of `fine` changed or that are off by half the tolerance. Both know their changes
/// (mark_changes).
void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which);

}  // namespace argil
