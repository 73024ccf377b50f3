// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn over the clay, and what is cut away of it.
#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "viewer/support/projected.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

constexpr double kMarkedRadiusMm = 10.0;
constexpr Vec3 kGreen{0.0, 1.0, 0.0};
constexpr Vec3 kRed{1.0, 0.0, 0.0};

/// How much greener than red a pixel is.
int green_at(const Image& image, const Vec3& seen) {
  const Rgb c = rgb_at(image, static_cast<int>(seen.x), static_cast<int>(seen.y));
  return c.green - std::max(c.red, c.blue);
}

int red_at(const Image& image, const Vec3& seen) {
  const Rgb c = rgb_at(image, static_cast<int>(seen.x), static_cast<int>(seen.y));
  return c.red - std::max(c.green, c.blue);
}

/// The distances of a ball on the plane y = 0, with 41 values each way.
viewer::SlicePicture ball_slice(double half_mm) {
  viewer::SlicePicture slice;
  slice.corner_mm = {-half_mm, 0.0, half_mm};
  slice.along_mm = {2.0 * half_mm, 0.0, 0.0};
  slice.down_mm = {0.0, 0.0, -2.0 * half_mm};
  slice.columns = slice.rows = 41;
  for (int row = 0; row < slice.rows; ++row) {
    for (int column = 0; column < slice.columns; ++column) {
      const double x = half_mm * (2.0 * column / (slice.columns - 1) - 1.0);
      const double z = half_mm * (1.0 - 2.0 * row / (slice.rows - 1));
      slice.distance_mm.push_back(static_cast<float>(std::hypot(x, z) - kMarkedRadiusMm));
    }
  }
  return slice;
}

class RendererMarksGl : public RendererScene {
 protected:
  void SetUp() override {
    RendererScene::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    put(ball_block(kMarkedRadiusMm, 6));
  }
};

TEST_F(RendererMarksGl, ARingHasItsTrueSize) {
  Picture picture;
  picture.rings.push_back({{0.0, -kMarkedRadiusMm, 0.0}, {0.0, -1.0, 0.0}, 4.0, kGreen});
  const Image image = draw(picture);
  for (int i = 0; i < 16; ++i) {
    const double turn = 0.4 * i;
    const Vec3 out{std::cos(turn), 0.0, std::sin(turn)};
    const Vec3 front{0.0, -kMarkedRadiusMm, 0.0};
    EXPECT_GT(green_at(image, projected(camera_, front + 4.0 * out)), 100) << turn;
    EXPECT_LT(green_at(image, projected(camera_, front + 3.0 * out)), 0) << turn;
    EXPECT_LT(green_at(image, projected(camera_, front + 5.0 * out)), 0) << turn;
  }
}

TEST_F(RendererMarksGl, ARingBehindClayIsFaint) {
  Picture picture;
  picture.rings.push_back({{0.0, kMarkedRadiusMm, 0.0}, {0.0, 1.0, 0.0}, 4.0, kGreen});
  const Vec3 place = projected(camera_, {4.0, kMarkedRadiusMm, 0.0});
  const int bare = green_at(draw({}), place);
  const int faint = green_at(draw(picture), place);
  EXPECT_GT(faint, bare + 10);
  EXPECT_LT(faint, 100);
}

TEST_F(RendererMarksGl, AFilledRingIsAPatch) {
  Picture picture;
  picture.rings.push_back({{0.0, -kMarkedRadiusMm, 0.0}, {0.0, -1.0, 0.0}, 4.0, kGreen, true});
  const Vec3 middle = projected(camera_, {0.0, -kMarkedRadiusMm, 0.0});
  EXPECT_GT(green_at(draw(picture), middle), green_at(draw({}), middle) + 40);
}

TEST_F(RendererMarksGl, AnArrowIsSeenInsideOfClayToo) {
  Picture picture;
  picture.arrows.push_back({{-6.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, kGreen});
  const Image image = draw(picture);
  EXPECT_GT(green_at(image, projected(camera_, {-3.0, 0.0, 0.0})), 80);
  // The head is wider than the shaft.
  const auto rows = [&](double x) {
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
      count += green_at(image, {projected(camera_, {x, 0.0, 0.0}).x, y + 0.5, 0.0}) > 60 ? 1 : 0;
    return count;
  };
  const double pixel = camera_.pixel_mm_at({});
  EXPECT_GT(rows(6.0 - 16.0 * pixel), rows(-3.0) + 4);
  EXPECT_EQ(rows(6.0 + 2.0 * pixel), 0);
}

TEST_F(RendererMarksGl, ALineGoesFromPointToPointAndIsFaintBehindClay) {
  Picture picture;
  picture.lines.push_back({{{-6.0, -kMarkedRadiusMm, 0.0}, {6.0, -kMarkedRadiusMm, 0.0}}, kGreen});
  const Image bare = draw({});
  const Image image = draw(picture);
  const auto gain = [&](const Image& with, const Vec3& at) {
    const Vec3 seen = projected(camera_, at);
    return green_at(with, seen) - green_at(bare, seen);
  };
  for (const double x : {-5.0, -2.0, 0.0, 3.0, 5.0}) {
    EXPECT_GT(gain(image, {x, -kMarkedRadiusMm, 0.0}), 100) << x;
  }
  EXPECT_EQ(gain(image, {-7.0, -kMarkedRadiusMm, 0.0}), 0) << "it is open";
  EXPECT_EQ(gain(image, {0.0, -kMarkedRadiusMm, 2.0}), 0);
  for (Vec3& point : picture.lines[0].points_mm) point.y = kMarkedRadiusMm;
  const Image behind = draw(picture);
  const int faint = gain(behind, {0.0, kMarkedRadiusMm, 0.0});
  EXPECT_GT(faint, 10);
  EXPECT_LT(3 * faint, 2 * gain(image, {0.0, -kMarkedRadiusMm, 0.0}));
}

TEST_F(RendererMarksGl, ALineOfOnePointIsNothing) {
  Picture picture;
  picture.lines.push_back({{{0.0, -kMarkedRadiusMm, 0.0}}, kGreen});
  EXPECT_EQ(draw(picture).rgb, draw({}).rgb);
}

TEST_F(RendererMarksGl, AnArrowWithoutLengthIsNothing) {
  Picture picture;
  picture.arrows.push_back({{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, kGreen});
  EXPECT_EQ(draw(picture).rgb, draw({}).rgb);
}

TEST_F(RendererMarksGl, APlaneTintsWhatIsBehindItAndIsHiddenByWhatIsBefore) {
  Picture picture;
  picture.planes.push_back({{}, {0.0, 1.0, 0.0}, 11.5, kGreen});
  const Image bare = draw({});
  const Image image = draw(picture);
  const Vec3 beside = projected(camera_, {11.0, 0.0, 8.0});
  EXPECT_GT(green_at(image, beside), green_at(bare, beside) + 10);
  EXPECT_EQ(green_at(image, projected(camera_, {})), green_at(bare, projected(camera_, {})));
}

TEST_F(RendererMarksGl, APinIsOfOneSizeAndShownThroughClay) {
  const auto pixels = [&](const Vec3& at) {
    Picture picture;
    picture.pins.push_back({at, kRed});
    const Image bare = draw({});
    const Image image = draw(picture);
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) count += rgb_at(image, x, y) == rgb_at(bare, x, y) ? 0 : 1;
    return count;
  };
  const int before = pixels({0.0, -kMarkedRadiusMm, 0.0});
  EXPECT_GT(before, 300);
  EXPECT_NEAR(pixels({0.0, kMarkedRadiusMm, 0.0}), before, 0.05 * before);
  Picture picture;
  picture.pins.push_back({{0.0, -kMarkedRadiusMm, 0.0}, kRed});
  const Vec3 tip = projected(camera_, {0.0, -kMarkedRadiusMm, 0.0});
  const int strong = red_at(draw(picture), tip - Vec3{0.0, 14.0, 0.0});
  picture.pins[0].at_mm.y = kMarkedRadiusMm;
  const Vec3 far_tip = projected(camera_, picture.pins[0].at_mm);
  const int faint = red_at(draw(picture), far_tip - Vec3{0.0, 14.0, 0.0});
  EXPECT_GT(strong, 150);
  EXPECT_LT(faint, strong - 20);
  EXPECT_GT(faint, 80);
}

TEST_F(RendererMarksGl, ASliceCutsTheClayBeforeItAway) {
  draw({});
  const viewer::DepthMap whole = renderer_->read_depth();
  Picture picture;
  picture.slice = ball_slice(12.0);
  draw(picture);
  const viewer::DepthMap cut = renderer_->read_depth();
  constexpr std::size_t kMiddle = std::size_t{kWidth} * (kHeight / 2) + kWidth / 2;
  EXPECT_NEAR(static_cast<double>(cut.depth_mm[kMiddle] - whole.depth_mm[kMiddle]),
              2.0 * kMarkedRadiusMm, 0.1);
}

TEST_F(RendererMarksGl, ASliceShowsTheMaterialHatchedWithItsOutline) {
  Picture picture;
  picture.slice = ball_slice(12.0);
  const Image image = draw(picture);
  const auto place = [&](double x) { return projected(camera_, {x, 0.0, 0.0}); };
  const auto sum_at = [&](int x) { return rgb_at(image, x, static_cast<int>(place(0.0).y)).sum(); };
  const int edge = static_cast<int>(place(kMarkedRadiusMm).x);
  // From the middle to the surface the same two tones, in turn.
  int darkest = 765;
  int lightest = 0;
  int turns = 0;
  for (int x = static_cast<int>(place(0.0).x); x < edge - 4; ++x) {
    darkest = std::min(darkest, sum_at(x));
    lightest = std::max(lightest, sum_at(x));
  }
  bool is_light = true;
  for (int x = static_cast<int>(place(0.0).x); x < edge - 4; ++x) {
    const bool was_light = std::exchange(is_light, 2 * sum_at(x) > darkest + lightest);
    turns += was_light && !is_light ? 1 : 0;
  }
  EXPECT_LT(darkest, lightest - 60);
  EXPECT_GE(turns, 4) << "lines of the hatching";
  int outline = 765;
  for (int x = edge - 2; x <= edge + 2; ++x) outline = std::min(outline, sum_at(x));
  EXPECT_LT(outline, darkest - 30) << "the surface is a dark line";
}

TEST_F(RendererMarksGl, BesideTheMaterialASliceShowsWhatIsBehind) {
  Picture picture;
  picture.slice = ball_slice(12.0);
  renderer_->clear();
  const Image bare = draw({});
  const Image image = draw(picture);
  const Vec3 outside = projected(camera_, {11.0, 0.0, 11.0});
  const int x = static_cast<int>(outside.x);
  const int y = static_cast<int>(outside.y);
  EXPECT_EQ(rgb_at(image, x, y), rgb_at(bare, x, y));
}

TEST_F(RendererMarksGl, BesideTheMaterialASliceHidesNoMarks) {
  renderer_->clear();
  Picture picture;
  picture.slice = ball_slice(12.0);
  picture.rings.push_back({{0.0, 5.0, 0.0}, {0.0, 1.0, 0.0}, 11.5, kGreen});
  const Image image = draw(picture);
  EXPECT_GT(green_at(image, projected(camera_, {11.5, 5.0, 0.0})), 100);
}

TEST_F(RendererMarksGl, APatchOnTheFarSideIsFaint) {
  Picture picture;
  picture.rings.push_back({{0.0, kMarkedRadiusMm, 0.0}, {0.0, 1.0, 0.0}, 4.0, kGreen, true});
  const Vec3 middle = projected(camera_, {0.0, kMarkedRadiusMm, 0.0});
  const int far_side = green_at(draw(picture), middle);
  picture.rings[0].normal.y = -1.0;
  EXPECT_GT(green_at(draw(picture), middle), far_side + 20);
}

TEST_F(RendererMarksGl, StereoShowsEachEyeItsOwnHalf) {
  Picture picture;
  picture.right_lens = camera_.eye(0.2).lens(content_mm_);
  picture.lens = camera_.eye(-0.2).lens(content_mm_);
  picture.pins.push_back({{0.0, -kMarkedRadiusMm, 0.0}, kRed});
  ASSERT_TRUE(renderer_->draw(picture, screen_->framebuffer(), kWidth, kHeight).ok());
  const Image image = renderer_->read_image(screen_->framebuffer(), kWidth, kHeight);
  const auto mean_red = [&](int from) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = from; x < from + kWidth / 2; ++x) {
        if (red_at(image, {x + 0.0, y + 0.0, 0.0}) < 150) continue;
        sum += x - from;
        ++count;
      }
    }
    EXPECT_GT(count, 50);
    return sum / count;
  };
  const double seen_left = mean_red(0);
  const double seen_right = mean_red(kWidth / 2);
  EXPECT_GT(seen_left, kWidth / 4 + 2) << "what is near is farther right for the left eye";
  EXPECT_LT(seen_right, kWidth / 4 - 2);
}

}  // namespace
}  // namespace argil::test
