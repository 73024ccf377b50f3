// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "level_stack.h"

namespace argil {

// LevelStack::sample and LevelStack::node_value over the leaves that `leaf_at(level, node)` gives:
// a const VdbLeaf*, or nullptr where there is none.

template <class LeafAt>
float sample_of(const LevelStack& stack, const LeafAt& leaf_at, int level, const Coord& node) {
  if (const VdbLeaf* found = leaf_at(level, node)) return found->buffer().data()[leaf_offset(node)];
  if (level == stack.top()) return stack.grid(level).tree().getValue(node);
  // Straight to the level that stores the cell: going up one level at a time would visit 8 nodes
  // for every level in between.
  int above = level + 1;
  while (above < stack.top() && leaf_at(above, node >> (above - level)) == nullptr) ++above;
  const int steps = above - level;
  const Coord low = node >> steps;
  const Coord rest = node - (low << steps);
  const float step = 1.0F / static_cast<float>(1 << steps);
  float sum = 0.0F;
  for (int i = 0; i <= (rest.x() != 0); ++i) {
    const float x = static_cast<float>(i != 0 ? rest.x() : (1 << steps) - rest.x()) * step;
    for (int j = 0; j <= (rest.y() != 0); ++j) {
      const float y = static_cast<float>(j != 0 ? rest.y() : (1 << steps) - rest.y()) * step;
      for (int k = 0; k <= (rest.z() != 0); ++k) {
        const float z = static_cast<float>(k != 0 ? rest.z() : (1 << steps) - rest.z()) * step;
        sum += x * y * z * sample_of(stack, leaf_at, above, low.offsetBy(i, j, k));
      }
    }
  }
  return sum;
}

template <class LeafAt>
float node_value_of(const LevelStack& stack, const LeafAt& leaf_at, int level, const Coord& node) {
  for (int finer = 0; finer < level; ++finer) {
    const Coord fine = node << (level - finer);
    if (const VdbLeaf* found = leaf_at(finer, fine)) {
      return found->buffer().data()[leaf_offset(fine)];
    }
  }
  return sample_of(stack, leaf_at, level, node);
}

}  // namespace argil
