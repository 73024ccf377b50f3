// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/reference_image.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

std::shared_ptr<const ReferencePixels> pixels(int width, int height) {
  ReferencePixels made;
  made.width = width;
  made.height = height;
  made.rgba.resize(static_cast<std::size_t>(4) * static_cast<std::size_t>(width * height), 255);
  return std::make_shared<const ReferencePixels>(std::move(made));
}

TEST(ReferenceImages, AViewIsStraightOnlyWhereTheCameraLooksAlongItsAxisUpright) {
  for (int n = 0; n < kStraightViews; ++n) {
    const auto view = static_cast<StraightView>(n);
    const ViewAxes axes = axes_of(view);
    EXPECT_LT(length(cross(axes.right, axes.up) - axes.back), 1e-12) << title_of(view);
    Camera camera;
    camera.look_from(axes.back, axes.up);
    EXPECT_EQ(straight_view_of(camera.lens({})), view) << title_of(view);
    camera.orbit(3.0, 0.0);
    EXPECT_EQ(straight_view_of(camera.lens({})), std::nullopt) << title_of(view);
    camera.look_from(axes.back, axes.right);
    EXPECT_NE(straight_view_of(camera.lens({})), view) << "rolled";
  }
  EXPECT_EQ(view_named("bottom"), StraightView::bottom);
  EXPECT_EQ(view_named("Bottom"), std::nullopt);
}

/// Twice as wide as high: its upper left pixel lies left of and above its middle, in every view.
TEST(ReferenceImages, StandInTheirViewAsLargeAsWasAsked) {
  for (int n = 0; n < kStraightViews; ++n) {
    ReferenceImage image;
    image.view = static_cast<StraightView>(n);
    image.right_mm = 10.0;
    image.up_mm = -4.0;
    image.width_mm = 60.0;
    image.pixels = pixels(20, 10);
    const ViewAxes axes = axes_of(image.view);
    const auto marks = marks_of({image}, image.view);
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_LT(length(marks[0].corner_mm - (-20.0 * axes.right + 11.0 * axes.up)), 1e-12);
    EXPECT_LT(length(marks[0].along_mm - 60.0 * axes.right), 1e-12);
    EXPECT_LT(length(marks[0].down_mm + 30.0 * axes.up), 1e-12);
    EXPECT_TRUE(marks_of({image}, std::nullopt).empty());
    const auto other = static_cast<StraightView>((n + 1) % kStraightViews);
    EXPECT_TRUE(marks_of({image}, other).empty());
  }
}

TEST(ReferenceImages, ThatAreHiddenOrCouldNotBeReadAreNotShown) {
  ReferenceImage image;
  EXPECT_TRUE(marks_of({image}, image.view).empty());
  image.pixels = pixels(1, 1);
  EXPECT_EQ(marks_of({image}, image.view).size(), 1U);
  image.is_visible = false;
  EXPECT_TRUE(marks_of({image}, image.view).empty());
}

/// Of one channel; the others are the same.
std::vector<int> shades_of(const PixelLevel& level) {
  std::vector<int> shades;
  for (std::size_t n = 0; n < level.rgba.size(); n += 4) {
    for (std::size_t c = 1; c < 4; ++c) EXPECT_EQ(level.rgba[n + c], level.rgba[n]);
    shades.push_back(level.rgba[n]);
  }
  return shades;
}

std::shared_ptr<const ReferencePixels> levels_of(int width, int height,
                                                 const std::vector<int>& shades) {
  std::vector<std::uint8_t> rgba;
  for (const int shade : shades) rgba.insert(rgba.end(), 4, static_cast<std::uint8_t>(shade));
  const Progress never_stops;
  return with_smaller(width, height, std::move(rgba), Pace(never_stops, "read"));
}

TEST(ReferenceImages, HasSmallerOnesThatAreMeansOfWhatTheyCover) {
  const auto even = levels_of(4, 2, {0, 10, 100, 110, 20, 30, 120, 130});
  ASSERT_EQ(even->smaller.size(), 2U);
  EXPECT_EQ(even->smaller[0].width, 2);
  EXPECT_EQ(even->smaller[0].height, 1);
  EXPECT_EQ(shades_of(even->smaller[0]), (std::vector<int>{15, 115}));
  EXPECT_EQ(shades_of(even->smaller[1]), (std::vector<int>{65}));
  // Five columns: each of the two covers two of them and half of the middle one.
  const auto odd = levels_of(5, 1, {50, 50, 100, 200, 200});
  EXPECT_EQ(shades_of(odd->smaller[0]), (std::vector<int>{60, 180}));
  EXPECT_EQ(shades_of(odd->smaller[1]), (std::vector<int>{120}));
  EXPECT_TRUE(levels_of(1, 1, {7})->smaller.empty());
  // Nothing moves, however odd the sides are: a ramp's middle stays its middle.
  std::vector<int> ramp;
  ramp.reserve(127);
  for (int n = 0; n < 127; ++n) ramp.push_back(2 * n);
  const auto narrow = levels_of(127, 1, ramp);
  ASSERT_EQ(narrow->smaller.size(), 6U);
  EXPECT_NEAR(shades_of(narrow->smaller.back())[0], 126, 2);
  // All black and all white stay so.
  for (const int shade : {0, 255}) {
    const auto flat = levels_of(13, 7, std::vector<int>(13 * 7, shade));
    for (const PixelLevel& level : flat->smaller) {
      for (const int each : shades_of(level)) EXPECT_EQ(each, shade);
    }
  }
}

TEST(ReferenceImages, EndsWhereItIsToldToStop) {
  int left = 10;
  const Progress stops = [&](std::string_view, double) { return --left > 0; };
  EXPECT_THROW(with_smaller(64, 64, std::vector<std::uint8_t>(4 * 64 * 64), Pace(stops, "read")),
               Interrupted);
  EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace argil::viewer
