// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/pinholes.h"

#include <gtest/gtest.h>

#include "argil/engine/sculpture.h"

namespace argil {
namespace {

void put(Image& image, int x, int y, int width, int height, const Rgb8& color) {
  for (int row = y; row < y + height; ++row) {
    for (int column = x; column < x + width; ++column) {
      const auto at = 3 * static_cast<std::size_t>(row * image.width + column);
      for (std::size_t n = 0; n < 3; ++n) image.rgb[at + n] = color[n];
    }
  }
}

constexpr Rgb8 kGrey{60, 61, 63};
constexpr Rgb8 kBrown{190, 130, 100};

/// Clay of 60 x 40 in the middle of the background.
Image clay_picture() {
  Image image{100, 80, std::vector<std::uint8_t>(3 * 100 * 80)};
  put(image, 0, 0, 100, 80, kGrey);
  put(image, 20, 20, 60, 40, kBrown);
  return image;
}

TEST(Pinholes, AreCountedInsideOfTheClayOnly) {
  Image image = clay_picture();
  EXPECT_EQ(test::pinholes(image, 0, 100), 0);
  put(image, 30, 30, 1, 1, kGrey);
  put(image, 50, 40, 3, 2, kGrey);
  EXPECT_EQ(test::pinholes(image, 0, 100), 2);
  EXPECT_EQ(test::pinholes(image, 40, 100), 1) << "one is left of what is looked at";
}

TEST(Pinholes, AreNeitherNotchesNorLargeHolesNorShadows) {
  Image image = clay_picture();
  put(image, 20, 30, 4, 1, kGrey);
  put(image, 40, 30, 10, 10, kGrey);
  put(image, 60, 30, 2, 2, {20, 14, 10});
  EXPECT_EQ(test::pinholes(image, 0, 100), 0);
}

}  // namespace
}  // namespace argil
