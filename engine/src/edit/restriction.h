// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
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

/// The leaves of a level that decide the nodes of one leaf of the next coarser level, by bits of
/// their place along each axis: the one below the coarse leaf's first octant, and the two that it
/// covers. Null where there is none.
struct FineLeaves {
  std::array<const float*, 27> now{};
  std::array<const NodeRows*, 27> changed{};  ///< null where nothing changed
  bool any_present = false;
  bool any_changed = false;  ///< of those that are there
  bool any_touched = false;  ///< of all: what changed may be no more
};

/// Of the coarse leaf at `coarse_origin`, stored or not.
FineLeaves fine_leaves(FineSource& fine, const Coord& coarse_origin);

/// What a finer level says of a coarse leaf's nodes.
struct Restricted {
  NodeRows decided;   ///< where the fine node at the same point is in the fine band
  NodeRows averaged;  ///< of those: full weighting; else the fine node's own value
  NodeRows changed;   ///< some fine node that has a weight changed in the edit
  LeafValues value;   ///< of those decided
};

/// The restriction of the finer level to the nodes of a coarse leaf: full weighting (the adjoint of
/// trilinear prolongation) where all 27 fine nodes around are in the fine band, else the value of
/// the fine node at the same point. A mean of less than 1e-5 fine voxels is 0. Mirror images of
/// fine nodes give the mirror image in every bit.
void restrict_leaf(const FineLeaves& fine, float fine_band_mm, Restricted& out);

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
