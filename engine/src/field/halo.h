// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "field/level_stack.h"
#include "rows/rows.h"

namespace argil {

static_assert(kRowNodes == kLeafSide);

/// From a node of a HaloBlock to the next along each axis.
inline constexpr std::array<int, 3> kHaloStride{HaloBlock::kSide * HaloBlock::kRow,
                                                HaloBlock::kRow, 1};

/// Of three leaves that stand beside each other along z, those at (x, y) of the 3^3 around a leaf,
/// each -1 to 1: the rows that belong to its halo.
void copy_halo_rows(const std::array<const float*, 3>& along, int x, int y, HaloBlock& block);

/// The 3^3 leaves that a block has nodes of, z fastest.
inline constexpr std::size_t kHaloLeaves = 27;

/// Calls visit(n, origin) for them, the one at `origin` in the middle.
template <class Visit>
void for_each_halo_leaf(const Coord& origin, const Visit& visit) {
  std::size_t n = 0;
  for (int x = -kLeafSide; x <= kLeafSide; x += kLeafSide) {
    for (int y = -kLeafSide; y <= kLeafSide; y += kLeafSide) {
      for (int z = -kLeafSide; z <= kLeafSide; z += kLeafSide) visit(n++, origin.offsetBy(x, y, z));
    }
  }
}

/// Copies a leaf and what is around it into a block. `values(n)` gives the nodes of each of the
/// leaves, never null.
template <class Values>
void gather_halo(const Values& values, HaloBlock& block) {
  for (int column = 0; column < 9; ++column) {
    const auto n = static_cast<std::size_t>(3 * column);
    copy_halo_rows({values(n), values(n + 1), values(n + 2)}, column / 3 - 1, column % 3 - 1, block);
  }
}

/// As the stack has them; NaN where the level has no leaf.
void gather_halo(const LevelStack& stack, int level, const Coord& origin, HaloBlock& block);

/// Puts a leaf's own values in the middle.
void set_own(const float* values, HaloBlock& block);

}  // namespace argil
