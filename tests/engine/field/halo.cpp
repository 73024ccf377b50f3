// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/halo.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace argil {
namespace {

/// Of some rows everything that differences of two nodes to every side read, and all own nodes.
TEST(Halo, OfSomeRowsIsAsOfAll) {
  std::mt19937_64 dice(11);
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  std::vector<LeafValues> leaves(kHaloLeaves);
  std::array<const float*, kHaloLeaves> values{};
  for (std::size_t n = 0; n < kHaloLeaves; ++n) {
    for (float& value : leaves[n]) value = some(dice);
    values[n] = leaves[n].data();
  }
  HaloBlock all;
  gather_halo(values, all);
  for (int round = 0; round < 100; ++round) {
    const std::uint64_t rows = dice() & dice() & dice();
    HaloBlock part;
    std::fill(std::begin(part.value), std::end(part.value),
              std::numeric_limits<float>::quiet_NaN());
    gather_halo(values, rows, part);
    for (int n = 0; n < kLeafNodes; ++n) {
      const int at = HaloBlock::index(n / 64, n / 8 % 8, n % 8);
      ASSERT_EQ(part.value[at], all.value[at]);
      if ((rows >> n / 8 & 1U) == 0) continue;
      for (const int stride : kHaloStride) {
        for (int step = -HaloBlock::kHalo; step <= HaloBlock::kHalo; ++step) {
          ASSERT_EQ(part.value[at + step * stride], all.value[at + step * stride]) << n;
        }
      }
    }
  }
}

}  // namespace
}  // namespace argil
