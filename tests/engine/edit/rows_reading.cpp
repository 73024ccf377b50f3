// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/rows_reading.h"

#include <array>
#include <cstdlib>

#include <gtest/gtest.h>

namespace argil {
namespace {

/// A sweep reads two nodes to every side along each axis, and none across.
TEST(RowsReading, AreThoseWithinTwoAlongAnAxis) {
  constexpr std::array<std::array<int, 2>, 5> kOffsets{{{0, 0}, {-8, 0}, {8, 0}, {0, -8}, {0, 8}}};
  for (std::size_t leaf = 0; leaf < kOffsets.size(); ++leaf) {
    for (int row = 0; row < 64; ++row) {
      const int x = kOffsets[leaf][0] + row / 8;
      const int y = kOffsets[leaf][1] + row % 8;
      std::uint64_t expected = 0;
      for (int n = 0; n < 64; ++n) {
        const int dx = std::abs(n / 8 - x);
        const int dy = std::abs(n % 8 - y);
        if ((dx == 0 && dy <= 2) || (dy == 0 && dx <= 2)) expected |= std::uint64_t{1} << n;
      }
      std::array<std::uint64_t, 5> moved{};
      moved[leaf] = std::uint64_t{1} << row;
      EXPECT_EQ(rows_reading(moved[0], moved[1], moved[2], moved[3], moved[4]), expected)
          << leaf << ' ' << row;
    }
  }
}

}  // namespace
}  // namespace argil
