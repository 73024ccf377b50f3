// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/alpha_image.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/alpha_maker.h"

namespace argil {
namespace {

using test::checker_image;
using test::image_of;
using test::ramp_image;
using testing::HasSubstr;
using Beyond = AlphaImage::Beyond;

std::string refusal_of(int width, int height, std::size_t pixels) {
  const auto made = AlphaImage::make(width, height, std::vector<std::uint16_t>(pixels));
  return made ? "" : made.error().message;
}

double any_grey(std::mt19937& random) { return static_cast<double>(random() % 1000) / 1e3; }

TEST(AlphaImage, RefusesSidesOutOfRangeAndMissingPixels) {
  EXPECT_EQ(refusal_of(1, 8, 8), "the image's width is 1 pixels; must be from 2 to 4096");
  EXPECT_EQ(refusal_of(8, 4097, 8), "the image's height is 4097 pixels; must be from 2 to 4096");
  EXPECT_EQ(refusal_of(-3, 8, 8), "the image's width is -3 pixels; must be from 2 to 4096");
  EXPECT_THAT(refusal_of(8, 8, 63), HasSubstr("8 by 8 pixels came with 63 of them"));
  EXPECT_EQ(refusal_of(2, 4096, 8192), "");
}

TEST(AlphaImage, HasARampExactlyAndAPixelFourNinthsHigh) {
  const auto ramp = ramp_image(64);
  for (double x = 0.05; x < 0.95; x += 0.013) {
    EXPECT_NEAR(ramp->at(0, x, 0.4, Beyond::edge), x, 1e-5) << x;
  }
  const auto pixel =
      image_of(9, 9, [](int column, int row) { return column == 4 && row == 4 ? 1 : 0; });
  EXPECT_NEAR(pixel->at(0, 0.5, 0.5, Beyond::edge), 4.0 / 9.0, 1e-9);
  EXPECT_NEAR(pixel->at(0, 0.5 + 1.0 / 9.0, 0.5, Beyond::edge), 1.0 / 9.0, 1e-9);
  EXPECT_EQ(pixel->at(0, 0.5 + 2.0 / 9.0, 0.5, Beyond::edge), 0.0);
}

/// 256 of 65536 greys are one of 8 bits: between two of these there is a slope and no step.
TEST(AlphaImage, TellsSixteenBitsApart) {
  const auto faint = image_of(
      257, 4, [](int column, int) { return static_cast<double>(30000 + column) / 65535.0; });
  double before = 0.0;
  for (double x = 0.01; x < 0.99; x += 0.001) {
    const double grey = faint->at(0, x, 0.5, Beyond::edge);
    EXPECT_GT(grey, before) << x;
    before = grey;
  }
}

TEST(AlphaImage, AveragesWhatIsFinerThanAskedFor) {
  const auto checker = checker_image(64, 1);
  EXPECT_EQ(checker->layer_of(0.3), 0);
  EXPECT_EQ(checker->layer_of(1.0), 0);
  EXPECT_EQ(checker->layer_of(1.01), 1);
  EXPECT_EQ(checker->layer_of(8.0), 3);
  EXPECT_EQ(checker->layer_of(1e9), 6);
  for (int layer = 1; layer <= 6; ++layer) {
    for (double x = 0.03; x < 1.0; x += 0.09) {
      EXPECT_NEAR(checker->at(layer, x, 0.7, Beyond::edge), 0.5, 1e-5) << layer << ' ' << x;
    }
  }
  // Of any sides the mean stays the same.
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{64, 64}, {37, 53}, {100, 3}, {2, 2}}) {
    const auto noise = image_of(width, height, [&](int, int) { return any_grey(random); });
    double sum = 0.0;
    for (const std::uint16_t pixel : noise->pixels()) sum += pixel / 65535.0;
    const double mean = sum / static_cast<double>(noise->pixels().size());
    const int last = noise->layer_of(1e9);
    double last_mean = 0.0;
    for (int n = 0; n < 400; ++n) {
      last_mean += noise->at(last, (n % 20 + 0.5) / 20, (n / 20 + 0.5) / 20, Beyond::repeat) / 400;
    }
    EXPECT_NEAR(last_mean, mean, 2e-3) << width << ' ' << height;
  }
}

TEST(AlphaImage, RepeatsWithoutASeamWhateverItsSides) {
  std::mt19937 random(5);
  for (const auto& [width, height] : {std::pair{16, 16}, {13, 21}}) {
    const auto noise = image_of(width, height, [&](int, int) { return any_grey(random); });
    for (int layer = 0; layer <= noise->layer_of(1e9); ++layer) {
      for (double t = -1.0; t < 1.0; t += 0.07) {
        const double here = noise->at(layer, t, 0.3, Beyond::repeat);
        EXPECT_NEAR(noise->at(layer, t + 1.0, 0.3, Beyond::repeat), here, 1e-9);
        EXPECT_NEAR(noise->at(layer, t, 1.3, Beyond::repeat), here, 1e-9);
        EXPECT_NEAR(noise->at(layer, t + 1e-9, 0.3, Beyond::repeat), here, 1e-6);
      }
    }
  }
}

TEST(AlphaImage, StaysWithinTheRangeItTells) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const auto noise = image_of(150, 90, [&](int column, int) {
    return column > 110 && random() % 40 == 0 ? 1.0 : 0.2 * static_cast<double>(column) / 150.0;
  });
  int tight = 0;
  for (int n = 0; n < 4000; ++n) {
    const int layer = static_cast<int>(random() % 4);
    const double x = between(-0.1, 1.0);
    const double y = between(-0.1, 1.0);
    const double wide = between(0.0, 0.3);
    const double high = between(0.0, 0.3);
    const AlphaImage::Range range = noise->range(layer, x, y, x + wide, y + high);
    for (int k = 0; k < 10; ++k) {
      const double grey =
          noise->at(layer, x + between(0.0, wide), y + between(0.0, high), Beyond::edge);
      ASSERT_GE(grey, range.least - 1e-5);
      ASSERT_LE(grey, range.most + 1e-5);
    }
    tight += range.most < 0.5 ? 1 : 0;
  }
  EXPECT_GT(tight, 50) << "a range that always holds all says nothing";
  EXPECT_EQ(noise->range().most, 1.0);
}

}  // namespace
}  // namespace argil
