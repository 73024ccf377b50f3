// SPDX-License-Identifier: GPL-3.0-or-later
// Which leaves levels need: parents, and parents of neighbours, so that levels of neighbours differ
// by at most one.
#pragma once

#include <optional>

#include "field/level_stack.h"

namespace argil {

/// Something that a leaf requires of the next coarser level and that is not there.
struct NestingFault {
  enum class Kind { no_parent, no_neighbour } kind = Kind::no_parent;
  int level = 0;
  Coord origin;
};

/// What is wrong with one leaf: its parent must be there, and so must the parent of each neighbour
/// where the surface passes, so that levels of neighbours differ by at most one.
std::optional<NestingFault> nesting_fault(const LevelStack& stack, int level, const Coord& origin);

/// The first fault of all leaves: by level, the finest first, then by origin.
/// Cost  about a microsecond a leaf on each core (a file with 193 000 leaves: docs/files.md).
std::optional<NestingFault> first_nesting_fault(const LevelStack& stack);

/// True when a leaf of the next finer level lies in or beside the leaf at `origin`, which must then
/// stay. `finer_present(origin)` says which there are.
template <class FinerPresent>
bool required_by_finer(const Coord& origin, FinerPresent&& finer_present) {
  const Coord first = (origin << 1).offsetBy(-kLeafSide);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        if (finer_present(first.offsetBy(i * kLeafSide, j * kLeafSide, k * kLeafSide))) return true;
      }
    }
  }
  return false;
}

/// Calls `visit(origin)` for the up to eight leaves of the next coarser level that a leaf requires:
/// the parents of itself and of its 26 neighbours.
template <class Visit>
void for_each_required_parent(const Coord& origin, Visit&& visit) {
  const Coord lo = leaf_origin(coarser(origin.offsetBy(-kLeafSide)));
  const Coord hi = leaf_origin(coarser(origin.offsetBy(kLeafSide)));
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
bool any_corner(const Coord& origin, const IsSo& is_so) {
  for (int x = 0; x <= kLeafSide; ++x) {
    for (int y = 0; y <= kLeafSide; ++y) {
      for (int z = 0; z <= kLeafSide; ++z) {
        const bool is_own = x < kLeafSide && y < kLeafSide && z < kLeafSide;
        if (!is_own && is_so(origin.offsetBy(x, y, z))) return true;
      }
    }
  }
  return false;
}

/// Whether the next finer level stores one of a leaf's eight children.
bool has_child(const LevelStack& stack, int level, const Coord& origin);

/// Whether a leaf holds nothing: no finer leaf, and no corner of its cells within the band.
bool is_empty(const LevelStack& stack, int level, const Coord& origin);

/// Whether `is_so(origin)` for the leaves of all of the up to eight cells around a node.
template <class IsSo>
bool all_around(const Coord& node, const IsSo& is_so) {
  const auto back = [](int at) { return (at & (kLeafSide - 1)) == 0 ? 1 : 0; };
  for (int i = 0; i <= back(node.x()); ++i) {
    for (int j = 0; j <= back(node.y()); ++j) {
      for (int k = 0; k <= back(node.z()); ++k) {
        if (!is_so(leaf_origin(node.offsetBy(-i, -j, -k)))) return false;
      }
    }
  }
  return true;
}

/// Whether not all nodes from `low` to `low` + `side` lie on one side of the surface.
bool sides_differ(const LevelStack& stack, int level, const Coord& low, int side);

}  // namespace argil
