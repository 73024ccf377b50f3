// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "field/leaf.h"

namespace argil {

// How a value is found among the leaves of nested levels. `leaves` says which there are:
//   int top()                                      the coarsest level
//   const float* values(int level, Coord node)     of the leaf that holds the node; null: none
//   float constant(Coord node)                     at the coarsest level where it has no leaf

/// Between two values, `rest` of 2^steps steps from the first. A mirror image has the same bits.
inline float lerp_steps(float from, float to, int rest, int steps) noexcept {
  const float part = static_cast<float>(rest) / static_cast<float>(1 << steps);
  return (1.0F - part) * from + part * to;
}

/// The value of a node among those of a level `steps` coarser, which `at` reads: interpolated from
/// the 1, 2, 4 or 8 around it, one axis after the other.
template <class At>
float interpolated_between(const Coord& node, int steps, const At& at) {
  assert(steps >= 0);
  const Coord low = node >> steps;
  const Coord rest = node - (low << steps);
  const auto along_z = [&](int i, int j) {
    const float here = at(low.offsetBy(i, j, 0));
    if (rest.z() == 0) return here;
    return lerp_steps(here, at(low.offsetBy(i, j, 1)), rest.z(), steps);
  };
  const auto along_y = [&](int i) {
    const float here = along_z(i, 0);
    return rest.y() == 0 ? here : lerp_steps(here, along_z(i, 1), rest.y(), steps);
  };
  const float here = along_y(0);
  return rest.x() == 0 ? here : lerp_steps(here, along_y(1), rest.x(), steps);
}

/// The value of a node at its own level: interpolated from the nearest coarser level that stores
/// it where this one does not.
template <class Leaves>
float sample_of(const Leaves& leaves, int level, const Coord& node) {
  if (const float* found = leaves.values(level, node)) return found[leaf_offset(node)];
  if (level == leaves.top()) return leaves.constant(node);
  // Straight to the level that stores the cell: going up one level at a time would visit 8 nodes
  // for every level in between.
  int above = level + 1;
  while (above < leaves.top() && leaves.values(above, node >> (above - level)) == nullptr) ++above;
  return interpolated_between(node, above - level,
                              [&](const Coord& n) { return sample_of(leaves, above, n); });
}

/// The value that the finest level which stores the node gives it; else as sample_of.
template <class Leaves>
float node_value_of(const Leaves& leaves, int level, const Coord& node) {
  for (int finer = 0; finer < level; ++finer) {
    const Coord fine = node << (level - finer);
    if (const float* found = leaves.values(finer, fine)) return found[leaf_offset(fine)];
  }
  return sample_of(leaves, level, node);
}

}  // namespace argil
