// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/field_window.h"

#include <numeric>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace argil {
namespace {

TEST(FieldWindowView, RunsFastestAlongZ) {
  std::vector<float> values(2 * 3 * 5);
  std::iota(values.begin(), values.end(), 0.0F);
  FieldWindowView view;
  view.nodes = {2, 3, 5};
  view.distance_mm = values;
  float next = 0.0F;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 5; ++k) EXPECT_EQ(view.at(i, j, k), next++);
    }
  }
  EXPECT_EQ(view.index(1, 2, 4), values.size() - 1);
}

TEST(FieldWindowView, IsTriviallyCopyableForTheServo) {
  EXPECT_TRUE(std::is_trivially_copyable_v<FieldWindowView>);
}

TEST(FieldWindowView, IndexesBlocksBeyondTwoToTheThirtyOne) {
  FieldWindowView view;
  view.nodes = {2048, 2048, 2048};
  EXPECT_EQ(view.index(2047, 2047, 2047), std::size_t{2048} * 2048 * 2048 - 1);
}

}  // namespace
}  // namespace argil
