// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/pen.h"

#include <array>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(PenPressure, IsTheShareOfWhatTheTabletSpans) {
  const PressureAxis axis{2, 100.0, 8292.0};
  const std::array<unsigned char, 1> mask{0b00000111};
  const std::array<double, 3> at_rest{10.0, 20.0, 100.0};
  const std::array<double, 3> half{10.0, 20.0, 4196.0};
  const std::array<double, 3> beyond{10.0, 20.0, 9000.0};
  EXPECT_DOUBLE_EQ(pressure_in(axis, mask, at_rest.data()).value(), 0.0);
  EXPECT_DOUBLE_EQ(pressure_in(axis, mask, half.data()).value(), 0.5);
  EXPECT_DOUBLE_EQ(pressure_in(axis, mask, beyond.data()).value(), 1.0);
}

TEST(PenPressure, CountsOnlyTheValuesThatCame) {
  const PressureAxis axis{9, 0.0, 4.0};
  const std::array<unsigned char, 2> mask{0b00000100, 0b00000010};  // the numbers 2 and 9
  const std::array<double, 2> values{77.0, 1.0};
  EXPECT_DOUBLE_EQ(pressure_in(axis, mask, values.data()).value(), 0.25);
}

TEST(PenEraser, IsToldByTheNameOfItsDevice) {
  EXPECT_TRUE(is_eraser_name("Wacom Intuos Pro M Pen eraser"));
  EXPECT_TRUE(is_eraser_name("HUION Tablet Eraser (0)"));
  EXPECT_FALSE(is_eraser_name("Wacom Intuos Pro M Pen stylus"));
  EXPECT_FALSE(is_eraser_name(""));
}

TEST(PenPressure, IsNotThereWhenItDidNotChange) {
  const std::array<unsigned char, 1> mask{0b00000011};
  const std::array<double, 2> values{1.0, 2.0};
  EXPECT_FALSE(pressure_in({2, 0.0, 1.0}, mask, values.data()));
  EXPECT_FALSE(pressure_in({12, 0.0, 1.0}, mask, values.data()));
  EXPECT_FALSE(pressure_in({1, 3.0, 3.0}, mask, values.data())) << "a span of nothing";
}

}  // namespace
}  // namespace argil::viewer
