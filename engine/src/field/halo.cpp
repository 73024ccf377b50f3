// SPDX-License-Identifier: GPL-3.0-or-later
// Rows are copied along z, leaf by leaf: most of what a halo holds lies in one leaf.
#include "field/halo.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>

#include "field/leaf_finder.h"

namespace argil {
namespace {

/// Not std::copy_n, which GCC makes a call of.
template <std::size_t kCount>
void copy_floats(const float* from, float* to) noexcept {
  std::memcpy(to, from, kCount * sizeof(float));
}

}  // namespace

void gather_halo(const std::array<const float*, kHaloLeaves>& values, HaloBlock& block) {
  constexpr int kHalo = HaloBlock::kHalo;
  const auto row_of = [](int i, int j) { return kLeafSide * (kLeafSide * (i & 7) + (j & 7)); };
  const auto copy = [&](const float* leaf, int i, int j) {
    copy_floats<kLeafSide>(leaf + row_of(i, j), block.value + HaloBlock::index(i, j, 0));
  };
  assert(std::none_of(values.begin(), values.end(), [](const float* leaf) { return !leaf; }));
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      float* to = block.value + HaloBlock::index(i, j, 0);
      copy_floats<kHalo>(values[5] + row_of(i, j) + kLeafSide - kHalo, to - kHalo);
      copy_floats<kLeafSide>(values[0] + row_of(i, j), to);
      copy_floats<kHalo>(values[6] + row_of(i, j), to + kLeafSide);
    }
    for (int n = 0; n < kHalo; ++n) {
      copy(values[1], n - kHalo, i);
      copy(values[2], kLeafSide + n, i);
      copy(values[3], i, n - kHalo);
      copy(values[4], i, kLeafSide + n);
    }
  }
}

void gather_halo(const std::array<const float*, kHaloLeaves>& values, std::uint64_t rows,
                 HaloBlock& block) {
  if (rows == ~std::uint64_t{0}) return gather_halo(values, block);
  constexpr int kHalo = HaloBlock::kHalo;
  constexpr int kLast = kLeafSide - kHalo;
  const auto offset = [](int i, int j) { return kLeafSide * (kLeafSide * i + j); };
  const auto copy = [&](std::size_t leaf, int from_i, int from_j, int i, int j) {
    copy_floats<kLeafSide>(values[leaf] + offset(from_i, from_j),
                           block.value + HaloBlock::index(i, j, 0));
  };
  set_own(values[0], block);
  for (; rows != 0; rows &= rows - 1) {
    const int row = std::countr_zero(rows);
    const int i = row / kLeafSide;
    const int j = row % kLeafSide;
    float* to = block.value + HaloBlock::index(i, j, 0);
    copy_floats<kHalo>(values[5] + offset(i, j) + kLast, to - kHalo);
    copy_floats<kHalo>(values[6] + offset(i, j), to + kLeafSide);
    for (int n = i; n < kHalo; ++n) copy(1, kLast + n, j, n - kHalo, j);
    for (int n = 0; n <= i - kLast; ++n) copy(2, n, j, kLeafSide + n, j);
    for (int n = j; n < kHalo; ++n) copy(3, i, kLast + n, i, n - kHalo);
    for (int n = 0; n <= j - kLast; ++n) copy(4, i, n, i, kLeafSide + n);
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
  gather_halo(around, block);
}

void set_own(const float* values, HaloBlock& block) {
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      const float* row = values + kLeafSide * (kLeafSide * i + j);
      copy_floats<kLeafSide>(row, block.value + HaloBlock::index(i, j, 0));
    }
  }
}

}  // namespace argil
