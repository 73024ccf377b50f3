// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/leaf_finder.h"

#include <random>

#include <gtest/gtest.h>

namespace argil {
namespace {

/// Cubes of leaves within an inner node of the tree, over its borders, and where there is none.
TEST(LeafFinder, FindsAllOfACubeAtOnce) {
  LevelStack stack(1.0, 1);
  std::mt19937 dice(11);
  LeafValues values;
  values.fill(0.5F);
  for (int n = 0; n < 4000; ++n) {
    const auto at = [&] { return 8 * (static_cast<int>(dice() % 40) - 20); };
    stack.set_leaf(0, {at(), at(), at()}, values.data());
  }
  LeafFinder finder(stack, 0);
  int found = 0;
  for (int n = 0; n < 500; ++n) {
    const auto at = [&] { return 8 * (static_cast<int>(dice() % 60) - 30); };
    const Coord origin(at(), at(), at());
    const std::uint64_t there = finder.leaves_of_64(origin);
    for (int leaf = 0; leaf < 64; ++leaf) {
      const Coord place = origin + (Coord(leaf >> 4, leaf >> 2 & 3, leaf & 3) << 3);
      const bool is_there = stack.has_leaf(0, place);
      ASSERT_EQ((there >> leaf & 1U) != 0, is_there) << origin << ' ' << place;
      found += is_there ? 1 : 0;
    }
  }
  EXPECT_GT(found, 500);
}

}  // namespace
}  // namespace argil
