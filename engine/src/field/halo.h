// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "field/level_stack.h"
#include "rows/rows.h"

namespace argil {

static_assert(kRowNodes == kLeafSide);

/// From a node of a HaloBlock to the next along each axis.
inline constexpr std::array<int, 3> kHaloStride{HaloBlock::kSide * HaloBlock::kRow, HaloBlock::kRow,
                                                1};

/// The leaves that a block has nodes of: one and the two beside it along each axis.
inline constexpr std::size_t kHaloLeaves = 7;
inline constexpr std::array<std::array<int, 3>, kHaloLeaves> kHaloOffsets{
    {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Calls visit(n, origin) for them, the one at `origin` first.
template <class Visit>
void for_each_halo_leaf(const Coord& origin, const Visit& visit) {
  for (std::size_t n = 0; n < kHaloLeaves; ++n) {
    const auto& [x, y, z] = kHaloOffsets[n];
    visit(n, origin.offsetBy(kLeafSide * x, kLeafSide * y, kLeafSide * z));
  }
}

/// Copies a leaf and two nodes beside it along each axis, in the order of kHaloOffsets, none null.
/// What lies beside it along two axes or three is not set.
void gather_halo(const std::array<const float*, kHaloLeaves>& values, HaloBlock& block);

/// The same as far as differences at the nodes of `rows` (bit 8 x + y) read it, and the leaf's own
/// nodes; the rest is not set.
void gather_halo(const std::array<const float*, kHaloLeaves>& values, std::uint64_t rows,
                 HaloBlock& block);

/// As the stack has them; NaN where the level has no leaf.
void gather_halo(const LevelStack& stack, int level, const Coord& origin, HaloBlock& block);

/// Puts a leaf's own values in the middle.
void set_own(const float* values, HaloBlock& block);

}  // namespace argil
