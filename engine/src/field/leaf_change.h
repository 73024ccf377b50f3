// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>

#include "field/level_stack.h"
#include "field/row_bits.h"

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

/// The nodes of a leaf whose values differ; 0 and -0 are one value.
inline NodeRows changed_nodes(const float* from, const float* to) noexcept {
  assert(from != nullptr && to != nullptr);
  NodeRows rows;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row] = static_cast<std::uint8_t>(changed_bits(from + 8 * row, to + 8 * row));
  }
  return rows;
}

/// The change of a leaf from values to others.
inline LeafChange change_of_values(int level, const Coord& origin, const float* from,
                                   const float* to) noexcept {
  LeafChange change{level, origin, false, changed_nodes(from, to), {}};
  for (std::size_t row = 0; row < change.flipped.size(); ++row) {
    change.flipped[row] =
        static_cast<std::uint8_t>(inside_bits(from + 8 * row) ^ inside_bits(to + 8 * row));
  }
  return change;
}

}  // namespace argil
