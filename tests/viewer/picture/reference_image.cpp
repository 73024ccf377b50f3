// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/reference_image.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

std::shared_ptr<const ReferencePixels> pixels(int width, int height) {
  ReferencePixels made{width, height, {}};
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

TEST(ReferenceImageTest, IsReducedToWhatACardHoldsByMeansOfFour) {
  // Columns of one shade each, so that means are told; an odd column is left out.
  const auto made = [](int width, int height) {
    ReferencePixels pixels{width, height, {}};
    for (int n = 0; n < width * height; ++n) {
      for (int c = 0; c < 4; ++c) {
        pixels.rgba.push_back(static_cast<std::uint8_t>(10 * (n % width) + 40 * (n / width) + c));
      }
    }
    return std::make_shared<const ReferencePixels>(std::move(pixels));
  };
  const auto whole = made(5, 2);
  EXPECT_EQ(reduced(whole, 5), whole) << "it fits";
  const auto half = reduced(whole, 4);
  ASSERT_EQ(half->width, 2);
  ASSERT_EQ(half->height, 1);
  EXPECT_EQ(half->rgba, (std::vector<std::uint8_t>{25, 26, 27, 28, 45, 46, 47, 48}));
  EXPECT_EQ(reduced(whole, 1)->rgba, (std::vector<std::uint8_t>{35, 36, 37, 38}));
  const auto line = reduced(made(1, 9), 3);
  EXPECT_EQ(line->width, 1);
  EXPECT_EQ(line->height, 2);
}

}  // namespace
}  // namespace argil::viewer
