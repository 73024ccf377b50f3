// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bitset>

#include "level_edit.h"

namespace argil {

/// The nodes of level L that decide the 8^3 nodes of one leaf place of level L+1: a 17^3 block that
/// starts one node below the place. `values` is null-free only where `present`.
struct FineNeighbourhood {
  static constexpr int kSide = 17;
  std::array<float, kSide * kSide * kSide> value;
  std::bitset<kSide * kSide * kSide> present;  ///< the level has a leaf there
  std::bitset<kSide * kSide * kSide> changed;  ///< the edit changed the value there
  bool any_present = false;
  bool any_changed = false;
};

/// Where restriction reads its finer level from.
class FineSource {
 public:
  virtual ~FineSource() = default;
  /// Values after the edit of a leaf of the finer level, or nullptr.
  virtual const float* now(const Coord& place) const = 0;
  /// Values before the edit when the edit changed that leaf, else nullptr.
  virtual const float* changed_from(const Coord& place) const = 0;
};

/// Gathers the neighbourhood of the coarse leaf place `coarse_place`.
void gather_fine(const FineSource& fine, const Coord& coarse_place, FineNeighbourhood& out);

/// The restriction of the finer level to coarse node (i, j, k) of the place, each 0 to 7: full
/// weighting (the adjoint of trilinear prolongation) where all 27 fine nodes around it are in the
/// fine band, else the value of the fine node at the same place. False, and `out` untouched, where
/// the finer level has no leaf or the fine node is outside its band.
/// `full`, when given, tells which of the two it was.
bool restrict_node(const FineNeighbourhood& fine, float fine_band, int i, int j, int k, float& out,
                   bool* full = nullptr);

/// A coarse value may differ from the restriction of the finer level by this share of a fine voxel:
/// leaves that were refined and not edited since are not restricted again.
inline constexpr float kRestrictionTolerance = 0.5F;

/// Which leaves are looked at.
enum class RestrictedLeaves {
  all,     ///< also those that only need their flags: extend() wants them
  touched  ///< those that the edit changed, here or in the finer level
};

/// Flags the nodes of `coarse` that the finer level decides, and overwrites those whose restriction
/// the edit of `fine` changed or that are off by half the tolerance. Both know their changes
/// (mark_changes).
void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which);

}  // namespace argil
