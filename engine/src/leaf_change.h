// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "level_stack.h"

namespace argil {

/// A leaf's level and origin, present or not.
struct LeafPlace {
  int level = 0;
  Coord place;

  friend bool operator==(const LeafPlace& a, const LeafPlace& b) noexcept {
    return a.level == b.level && a.place == b.place;
  }
  friend bool operator<(const LeafPlace& a, const LeafPlace& b) noexcept {
    return a.level != b.level ? a.level < b.level : a.place < b.place;
  }
};

struct LeafPlaceHash {
  std::size_t operator()(const LeafPlace& at) const noexcept {
    const auto bits = [](int v) { return static_cast<std::uint64_t>(v >> 3) & 0xfffff; };
    std::uint64_t key = bits(at.place.x()) << 40 | bits(at.place.y()) << 20 | bits(at.place.z());
    key ^= static_cast<std::uint64_t>(at.level) << 60;
    key *= 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(key ^ key >> 32);
  }
};

/// Nodes of a leaf: bit z of row 8 x + y.
using NodeRows = std::array<std::uint8_t, 64>;

/// One leaf that was added, removed or whose values changed, as edits report it to whoever keeps
/// something derived from the levels (the surface, windows).
struct LeafChange {
  int level = 0;
  Coord place;           ///< the leaf's origin, present now or not
  bool is_whole = true;  ///< it came or went, or more is not known: all of it counts
  NodeRows nodes{};      ///< else those whose values changed

  LeafPlace where() const noexcept { return {level, place}; }
};

/// Where the bits of two leaves differ.
inline NodeRows differing_nodes(const float* a, const float* b) noexcept {
  NodeRows rows{};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::array<std::uint32_t, 8> x;
    std::array<std::uint32_t, 8> y;
    std::memcpy(x.data(), a + 8 * row, sizeof x);
    std::memcpy(y.data(), b + 8 * row, sizeof y);
    unsigned bits = 0;
    for (unsigned z = 0; z < 8; ++z) bits |= (x[z] != y[z] ? 1U : 0U) << z;
    rows[row] = static_cast<std::uint8_t>(bits);
  }
  return rows;
}

}  // namespace argil
