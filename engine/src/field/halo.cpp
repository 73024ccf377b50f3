// SPDX-License-Identifier: GPL-3.0-or-later
// Rows are copied along z, leaf by leaf: most of what a halo holds lies in one leaf.
#include "field/halo.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "field/leaf_finder.h"

namespace argil {

void copy_halo_rows(const std::array<const float*, 3>& along, int x, int y, HaloBlock& block) {
  constexpr int kHalo = HaloBlock::kHalo;
  const auto first = [](int n) { return n > 0 ? kLeafSide : (n < 0 ? -kHalo : 0); };
  const auto last = [](int n) { return n > 0 ? kLeafSide + kHalo : (n < 0 ? 0 : kLeafSide); };
  assert(along[0] != nullptr && along[1] != nullptr && along[2] != nullptr);
  for (int i = first(x); i < last(x); ++i) {
    for (int j = first(y); j < last(y); ++j) {
      const int row = ((i & 7) << 6) | ((j & 7) << 3);
      float* to = block.value + HaloBlock::index(i, j, 0);
      std::copy_n(along[0] + row + kLeafSide - kHalo, kHalo, to - kHalo);
      std::copy_n(along[1] + row, kLeafSide, to);
      std::copy_n(along[2] + row, kHalo, to + kLeafSide);
    }
  }
}

void gather_halo(const LevelStack& stack, int level, const Coord& origin, HaloBlock& block) {
  assert(is_leaf_origin(origin));
  static const LeafValues unknown = [] {
    LeafValues values;
    values.fill(std::numeric_limits<float>::quiet_NaN());
    return values;
  }();
  LeafFinder leaves(stack, level);
  std::array<const float*, kHaloLeaves> around{};
  for_each_halo_leaf(origin, [&](std::size_t n, const Coord& at) {
    const float* values = leaves.values(at);
    around[n] = values != nullptr ? values : unknown.data();
  });
  gather_halo([&](std::size_t n) { return around[n]; }, block);
}

void set_own(const float* values, HaloBlock& block) {
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      const float* row = values + kLeafSide * (kLeafSide * i + j);
      std::copy_n(row, kLeafSide, block.value + HaloBlock::index(i, j, 0));
    }
  }
}

}  // namespace argil
