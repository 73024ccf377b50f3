// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "field/level_stack.h"

namespace argil {

/// A leaf's nodes with a halo of one node around them, z fastest.
inline constexpr std::size_t kHaloSide = kLeafSide + 2;
using LeafHalo = std::array<float, kHaloSide * kHaloSide * kHaloSide>;
inline constexpr std::array<std::size_t, 3> kHaloStride{kHaloSide * kHaloSide, kHaloSide, 1};

/// The index of a leaf's node `n` among them.
inline std::size_t halo_index(std::size_t n) noexcept {
  return ((n / 64 + 1) * kHaloSide + n / 8 % 8 + 1) * kHaloSide + n % 8 + 1;
}

/// As the stack has them; NaN where the level has no leaf.
LeafHalo with_halo(const LevelStack& stack, int level, const Coord& origin);

/// Puts a leaf's own values in the middle.
void overlay_leaf(const float* values, LeafHalo& halo);

}  // namespace argil
