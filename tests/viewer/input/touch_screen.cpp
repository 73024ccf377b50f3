// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/touch_screen.h"

#include <array>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(TouchScreenPlace, IsTheShareOfTheDisplayThatTheScreenSpans) {
  const TouchAxis x{0, 0.0, 65535.0, 1920.0};
  const TouchAxis y{1, 0.0, 65535.0, 1080.0};
  const std::array<unsigned char, 1> both{0b00000011};
  const std::array<double, 2> values{32767.5, 65535.0};
  EXPECT_DOUBLE_EQ(pixel_in(x, both, values.data()).value(), 960.0);
  EXPECT_DOUBLE_EQ(pixel_in(y, both, values.data()).value(), 1080.0);
  const std::array<unsigned char, 1> only_y{0b00000010};
  EXPECT_FALSE(pixel_in(x, only_y, values.data()));
  EXPECT_DOUBLE_EQ(pixel_in(y, only_y, values.data()).value(), 540.0);
}

}  // namespace
}  // namespace argil::viewer
