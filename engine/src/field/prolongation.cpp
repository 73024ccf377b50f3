// SPDX-License-Identifier: GPL-3.0-or-later
// Prolongation is trilinear. On nested nodes that is an average of two nodes along each axis in
// turn, so a node that both levels have keeps its value to the bit.
#include "field/prolongation.h"

#include <cassert>

namespace argil {

CoarseNodes coarse_nodes(const LevelStack& stack, int coarser, const Coord& origin) {
  assert(coarser > 0 && coarser <= stack.top() && is_leaf_origin(origin));
  return gather_coarse(
      origin,
      [&](const Coord& at) -> const float* {
        const VdbLeaf* leaf = stack.leaf(coarser, at);
        return leaf != nullptr ? leaf->buffer().data() : nullptr;
      },
      [&](const Coord& node) { return stack.sample(coarser, node); });
}

void prolong_leaf(const LevelStack& stack, int level, const Coord& origin, LeafValues& out) {
  assert(is_leaf_origin(origin));
  if (level == stack.top()) {
    out.fill(stack.grid(level).tree().getValue(origin));
    return;
  }
  upsample(coarse_nodes(stack, level + 1, origin), out);
  clamp_to(stack.band_mm(level), out);
}

}  // namespace argil
