// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_ranges.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(FreeRanges, NeverHandsOutAPlaceTwiceAndJoinsWhatComesBack) {
  std::mt19937 random(11);
  RecordProperty("seed", 11);
  constexpr std::uint32_t kSize = 4096;
  FreeRanges ranges(kSize);
  std::vector<bool> is_taken(kSize, false);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (int step = 0; step < 20000; ++step) {
    if (random() % 2 == 0) {
      const auto length = 1 + static_cast<std::uint32_t>(random() % 100);
      const std::uint32_t longest = ranges.longest();
      const auto begin = ranges.take(length);
      ASSERT_EQ(begin.has_value(), longest >= length);
      if (!begin) continue;
      ASSERT_LE(*begin + length, kSize);
      for (std::uint32_t i = *begin; i < *begin + length; ++i) {
        ASSERT_FALSE(is_taken[i]);
        is_taken[i] = true;
      }
      taken.emplace_back(*begin, length);
    } else if (!taken.empty()) {
      std::swap(taken[random() % taken.size()], taken.back());
      const auto [begin, length] = taken.back();
      taken.pop_back();
      ranges.give(begin, length);
      for (std::uint32_t i = begin; i < begin + length; ++i) is_taken[i] = false;
    }
  }
  for (const auto& [begin, length] : taken) ranges.give(begin, length);
  EXPECT_EQ(ranges.longest(), kSize);
}

}  // namespace
}  // namespace argil::viewer
