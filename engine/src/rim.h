// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "level_edit.h"

namespace argil {

/// A leaf's nodes with one node around them, z fastest.
inline constexpr std::size_t kRimSide = kLeafSide + 2;
using LeafRim = std::array<float, kRimSide * kRimSide * kRimSide>;
inline constexpr std::array<std::size_t, 3> kRimStride{kRimSide * kRimSide, kRimSide, 1};

/// The index of a leaf's node `n` in its rim.
inline std::size_t rim_index(std::size_t n) noexcept {
  return ((n / 64 + 1) * kRimSide + n / 8 % 8 + 1) * kRimSide + n % 8 + 1;
}

/// As the stack has them; NaN where the level has no leaf.
LeafRim with_rim(const LevelStack& stack, int level, const Coord& place);

/// Puts a leaf's own values in the middle.
void overlay_leaf(const LeafValues& values, LeafRim& rim);

}  // namespace argil
