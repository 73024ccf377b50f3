// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "field/level_stack.h"

namespace argil {

/// A leaf's level and origin, present or not.
struct LeafKey {
  int level = 0;
  Coord origin;

  friend bool operator==(const LeafKey& a, const LeafKey& b) noexcept {
    return a.level == b.level && a.origin == b.origin;
  }
  friend bool operator<(const LeafKey& a, const LeafKey& b) noexcept {
    return a.level != b.level ? a.level < b.level : a.origin < b.origin;
  }
};

struct LeafKeyHash {
  std::size_t operator()(const LeafKey& at) const noexcept {
    const auto bits = [](int v) { return static_cast<std::uint64_t>(v >> 3) & 0xfffff; };
    std::uint64_t key = bits(at.origin.x()) << 40 | bits(at.origin.y()) << 20 | bits(at.origin.z());
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
  Coord origin;          ///< the leaf's origin, present now or not
  bool is_whole = true;  ///< it came or went, or more is not known: all of it counts
  NodeRows nodes{};      ///< else those whose values changed
  NodeRows flipped{};    ///< and of those the ones that went from inside to outside or back

  LeafKey where() const noexcept { return {level, origin}; }
};

/// The nodes of a leaf of which `is_so(from, to)`.
template <class IsSo>
NodeRows nodes_where(const float* from, const float* to, const IsSo& is_so) noexcept {
  assert(from != nullptr && to != nullptr);
  constexpr std::array<std::uint32_t, 8> kBit{1, 2, 4, 8, 16, 32, 64, 128};
  NodeRows rows;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::uint32_t nodes = 0;
    for (std::size_t z = 0; z < 8; ++z) {
      nodes |= is_so(from[8 * row + z], to[8 * row + z]) ? kBit[z] : 0U;
    }
    rows[row] = static_cast<std::uint8_t>(nodes);
  }
  return rows;
}

/// Those whose values differ; 0 and -0 are one value.
inline NodeRows changed_nodes(const float* from, const float* to) noexcept {
  return nodes_where(from, to, [](float a, float b) { return a != b; });
}

/// The change of a leaf from values to others.
inline LeafChange change_of_values(int level, const Coord& origin, const float* from,
                                   const float* to) noexcept {
  return {level, origin, false, changed_nodes(from, to),
          nodes_where(from, to, [](float a, float b) { return (a < 0.0F) != (b < 0.0F); })};
}

}  // namespace argil
