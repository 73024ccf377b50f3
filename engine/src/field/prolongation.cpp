// SPDX-License-Identifier: GPL-3.0-or-later
// Prolongation is trilinear. On nested nodes that is an average of two nodes along each axis in
// turn, so a node that both levels have keeps its value to the bit.
#include "field/prolongation.h"

#include <algorithm>
#include <cassert>

#include "field/leaf_finder.h"
#include "field/row_bits.h"

namespace argil {
namespace {

using openvdb::CoordBBox;

/// The nodes that a leaf and a box have in common.
CoordBBox common_nodes(const Coord& origin, const CoordBBox& box) {
  return {Coord::maxComponent(origin, box.min()),
          Coord::minComponent(origin.offsetBy(kLeafSide - 1), box.max())};
}

bool any_below(const float* leaf, const CoordBBox& nodes, float side, float bound) {
  const unsigned first = static_cast<unsigned>(nodes.min().z() & (kLeafSide - 1));
  const unsigned count = static_cast<unsigned>(nodes.max().z() - nodes.min().z() + 1);
  const unsigned asked = (0xffU >> (kLeafSide - count)) << first;
  const unsigned outside = side < 0.0F ? 0xffU : 0U;
  for (int x = nodes.min().x(); x <= nodes.max().x(); ++x) {
    unsigned below = 0;
    for (int y = nodes.min().y(); y <= nodes.max().y(); ++y) {
      const float* row = leaf + leaf_offset(Coord(x, y, 0));
      below |= (inside_bits(row) ^ outside) | band_bits(row, bound);
    }
    if ((below & asked) != 0) return true;
  }
  return false;
}

}  // namespace

/// A value between others lies between them, but for its rounding.
bool may_be_below(const LevelStack& stack, int level, const CoordBBox& nodes, float side,
                  float bound) {
  constexpr float kRounding = 1.0F + 1e-5F;
  LeafFinder leaves(stack, level);
  bool may_be = false;
  for_each_leaf_origin(nodes, [&](const Coord& origin) {
    if (may_be) return;
    const CoordBBox common = common_nodes(origin, nodes);
    if (const float* leaf = leaves.values(origin)) {
      may_be = any_below(leaf, common, side, kRounding * bound);
    } else if (level == stack.top()) {
      may_be = side * stack.grid(level).tree().getValue(origin) < kRounding * bound;
    } else {
      const CoordBBox between(common.min() >> 1, (common.max() + Coord(1)) >> 1);
      may_be = may_be_below(stack, level + 1, between, side, bound);
    }
  });
  return may_be;
}

CoarseNodes coarse_nodes(const LevelStack& stack, int coarser, const Coord& origin) {
  assert(coarser > 0 && coarser <= stack.top() && is_leaf_origin(origin));
  LeafFinder leaves(stack, coarser);
  return gather_coarse(
      origin, [&](const Coord& at) { return leaves.values(at); },
      [&](const Coord& node) { return stack.sample(coarser, node); });
}

bool may_coarse_be_below(const LevelStack& stack, int coarser, const Coord& origin, float side,
                         float bound) {
  assert(coarser > 0 && coarser <= stack.top() && is_leaf_origin(origin) && bound > 0.0F);
  const Coord low = argil::coarser(origin);
  return may_be_below(stack, coarser, {low, low.offsetBy(kCoarseNodesSide - 1)}, side, bound);
}

bool any_coarse_below(const LevelStack& stack, int coarser, const Coord& origin, float side,
                      float bound) {
  if (!may_coarse_be_below(stack, coarser, origin, side, bound)) return false;
  const CoarseNodes nodes = coarse_nodes(stack, coarser, origin);
  return std::any_of(nodes.begin(), nodes.end(), [&](float value) { return side * value < bound; });
}

void prolong_leaf(const LevelStack& stack, int level, const Coord& origin, LeafValues& out) {
  assert(is_leaf_origin(origin));
  if (level == stack.top()) {
    out.fill(stack.grid(level).tree().getValue(origin));
    return;
  }
  const float band = stack.band_mm(level);
  const float side = stack.sample(level + 1, coarser(origin)) < 0.0F ? -1.0F : 1.0F;
  if (!may_coarse_be_below(stack, level + 1, origin, side, band)) {  // most often, and far cheaper
    out.fill(side * band);
    return;
  }
  upsample(coarse_nodes(stack, level + 1, origin), out);
  clamp_to(band, out);
}

}  // namespace argil
