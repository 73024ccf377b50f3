// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "level_edit.h"

namespace argil {

/// How far a finer leaf may differ from the next coarser level before it has to stay.
struct RetentionRule {
  float near_mm = 0.0F;   ///< within 1.5 voxels of the surface: the project's tolerance
  float outer_mm = 0.0F;  ///< within 3 voxels: half a voxel, so that a later refinement fits in
  float voxel_mm = 0.0F;  ///< of the finer level
};
RetentionRule retention_rule(const LevelStack& stack, int level, double tolerance_mm);

/// The same of one node's value and what the coarser level says there.
inline bool node_misses(float value, float coarse, const RetentionRule& rule) noexcept {
  const float away = std::min(std::abs(value), std::abs(coarse));
  const float allowed = away < 1.5F * rule.voxel_mm ? rule.near_mm : rule.outer_mm;
  return (away < 3.0F * rule.voxel_mm) & (std::abs(value - coarse) > allowed);
}

/// True when the coarser level would miss the surface in this leaf by more than the rule allows.
bool coarser_misses(const LeafValues& values, const CoarseNodes& coarse, const RetentionRule& rule);

/// True when a leaf of the next finer level is in or beside the leaf at `place`, which must then
/// stay: levels of neighbours differ by at most one.
template <class FinerPresent>
bool required_by_finer(const Coord& place, FinerPresent&& finer_present) {
  const Coord first = (place << 1).offsetBy(-kLeafSide);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        if (finer_present(first.offsetBy(i * kLeafSide, j * kLeafSide, k * kLeafSide))) return true;
      }
    }
  }
  return false;
}

/// The up to eight coarser places that a leaf requires: those of itself and its 26 neighbours.
template <class Visit>
void for_each_required_place(const Coord& place, Visit&& visit) {
  const Coord lo = place_of(coarser(place.offsetBy(-kLeafSide)));
  const Coord hi = place_of(coarser(place.offsetBy(kLeafSide)));
  for (int x = lo.x(); x <= hi.x(); x += kLeafSide) {
    for (int y = lo.y(); y <= hi.y(); y += kLeafSide) {
      for (int z = lo.z(); z <= hi.z(); z += kLeafSide) visit(Coord(x, y, z));
    }
  }
}

/// True when some value is within the band: the leaf holds more than constant matter or air.
bool has_band(const float* values, float band);

/// Whether some corner of a leaf's cells beyond its own nodes is so. The mirror image of a leaf has
/// those for its own.
template <class IsSo>
bool any_corner(const Coord& place, const IsSo& is_so) {
  for (int x = 0; x <= kLeafSide; ++x) {
    for (int y = 0; y <= kLeafSide; ++y) {
      for (int z = 0; z <= kLeafSide; ++z) {
        const bool is_own = x < kLeafSide && y < kLeafSide && z < kLeafSide;
        if (!is_own && is_so(place.offsetBy(x, y, z))) return true;
      }
    }
  }
  return false;
}

/// Whether a leaf of the next finer level lies in a place.
bool has_child(const LevelStack& stack, int level, const Coord& place);

/// Whether a leaf holds nothing: no finer leaf, and no corner of its cells within the band.
bool is_empty(const LevelStack& stack, int level, const Coord& place);

}  // namespace argil
