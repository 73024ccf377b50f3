// SPDX-License-Identifier: GPL-3.0-or-later
// Where the clay is seen, and how far: against a ball that is known exactly.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gl/gl_renderer.h"
#include "picture/stereo.h"
#include "viewer/support/projected.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

constexpr double kRadiusMm = 10.0;
/// 131 072 triangles: flat faces miss the ball by less than 0.1 % of its radius.
constexpr int kSplits = 7;
constexpr double kFlatMm = 0.001 * kRadiusMm;

double depth_at(const viewer::DepthMap& map, int x, int y) {
  const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
  return static_cast<double>(map.depth_mm[row + static_cast<std::size_t>(x)]);
}

struct Extent {
  int left = std::numeric_limits<int>::max();
  int right = -1;
  int top = left;
  int bottom = -1;
};

Extent clay_extent(const viewer::DepthMap& map) {
  Extent e;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!std::isfinite(depth_at(map, x, y))) continue;
      e.left = std::min(e.left, x);
      e.right = std::max(e.right, x);
      e.top = std::min(e.top, y);
      e.bottom = std::max(e.bottom, y);
    }
  }
  return e;
}

/// How far along the view the ball is seen by a ray, infinite past it.
double ball_depth(const Ray& ray, const viewer::Lens& lens, double radius) {
  const Vec3& from = ray.origin_mm;
  const double b = dot(from, ray.direction);
  const double c = dot(from, from) - radius * radius;
  if (b * b < c) return std::numeric_limits<double>::infinity();
  const Vec3 hit = from + (-b - std::sqrt(b * b - c)) * ray.direction;
  return dot(lens.eye_mm - hit, lens.back);
}

class RendererDepthGl : public RendererScene {
 protected:
  /// Every pixel has the ball's depth, but on its outline, where a pixel's centre decides.
  void expect_ball_depth() {
    const viewer::DepthMap map = renderer_->read_depth();
    ASSERT_EQ(map.width, kWidth);
    ASSERT_EQ(map.height, kHeight);
    const viewer::Lens lens = camera_.lens(content_mm_);
    int compared = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Ray ray = camera_.ray_at({x + 0.5, y + 0.5});
        const double depth = depth_at(map, x, y);
        if (!std::isfinite(ball_depth(ray, lens, kRadiusMm + kFlatMm))) {
          EXPECT_FALSE(std::isfinite(depth)) << x << " " << y;
        } else if (std::isfinite(ball_depth(ray, lens, 0.98 * kRadiusMm))) {
          EXPECT_NEAR(depth, ball_depth(ray, lens, kRadiusMm), 6.0 * kFlatMm) << x << " " << y;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 5000);
  }
};

TEST_F(RendererDepthGl, SilhouetteIsWhereTheCameraSaysToAPixel) {
  put(ball_block(kRadiusMm, kSplits));
  draw({});
  // The outline of a ball at distance d is the circle of radius r sqrt(1 - (r/d)^2), nearer by
  // r^2 / d.
  const viewer::Lens lens = camera_.lens(content_mm_);
  const double d = length(lens.eye_mm);
  const double outline = kRadiusMm * std::sqrt(1.0 - kRadiusMm * kRadiusMm / (d * d));
  const Vec3 middle = kRadiusMm * kRadiusMm / d * lens.back;
  const Extent e = clay_extent(renderer_->read_depth());
  EXPECT_NEAR(e.left, projected(camera_, middle - outline * lens.right).x, 1.0);
  EXPECT_NEAR(e.right + 1, projected(camera_, middle + outline * lens.right).x, 1.0);
  EXPECT_NEAR(e.top, projected(camera_, middle + outline * lens.up).y, 1.0);
  EXPECT_NEAR(e.bottom + 1, projected(camera_, middle - outline * lens.up).y, 1.0);
}

TEST_F(RendererDepthGl, DepthIsTheBallsOwn) {
  put(ball_block(kRadiusMm, kSplits));
  draw({});
  expect_ball_depth();
}

TEST_F(RendererDepthGl, DepthIsTheBallsOwnOffTheCentreAndInAParallelLens) {
  put(ball_block(kRadiusMm, kSplits));
  camera_.set_target({6.0, 0.0, -4.0});
  camera_.orbit(37.0, 21.0);
  camera_.set_parallel(true);
  draw({});
  expect_ball_depth();
}

TEST_F(RendererDepthGl, DepthIsTheBallsOwnWithSeveralSamplesAPixel) {
  auto made = viewer::make_gl_renderer_with({4, false});
  ASSERT_TRUE(made.ok()) << made.error().message;
  renderer_ = std::move(made).value();
  put(ball_block(kRadiusMm, kSplits));
  const Image image = draw({});
  const viewer::DepthMap map = renderer_->read_depth();
  const viewer::Lens lens = camera_.lens(content_mm_);
  // A sample lies up to half a pixel from the middle: compared where the ball faces the eye.
  for (int y = 100; y < 140; ++y) {
    for (int x = 140; x < 180; ++x) {
      const double exact = ball_depth(camera_.ray_at({x + 0.5, y + 0.5}), lens, kRadiusMm);
      EXPECT_NEAR(depth_at(map, x, y), exact, 0.05);
    }
  }
  // Several samples are there: the outline's pixels lie between clay and background.
  const Extent e = clay_extent(map);
  const int inside = rgb_at(image, e.left + 3, kHeight / 2).red;
  const int outside = rgb_at(image, e.left - 3, kHeight / 2).red;
  bool is_between = false;
  for (int y = kHeight / 2 - 20; y < kHeight / 2 + 20; ++y) {
    for (int x = e.left - 1; x < e.left + 3; ++x) {
      const int red = rgb_at(image, x, y).red;
      is_between = is_between || (red > outside + 8 && red < inside - 8);
    }
  }
  EXPECT_TRUE(is_between);
}

TEST_F(RendererDepthGl, MarksLeaveTheDepthOfTheClay) {
  put(ball_block(kRadiusMm, 5));
  draw({});
  const auto bare = renderer_->read_depth().depth_mm;
  Picture picture;
  picture.rings.push_back({{0.0, -10.0, 0.0}, {0.0, -1.0, 0.0}, 3.0, {1.0, 1.0, 1.0}, true});
  picture.arrows.push_back({{0.0, -10.0, 0.0}, {0.0, -14.0, 3.0}});
  picture.planes.push_back({{}, {1.0, 0.0, 0.0}, 12.0});
  picture.pins.push_back({{0.0, 0.0, 10.0}});
  draw(picture);
  EXPECT_EQ(renderer_->read_depth().depth_mm, bare);
}

TEST_F(RendererDepthGl, IsEmptyBeforeTheFirstPictureAndInfiniteWithoutClay) {
  EXPECT_TRUE(renderer_->read_depth().depth_mm.empty());
  draw({});
  for (const float depth : renderer_->read_depth().depth_mm) EXPECT_FALSE(std::isfinite(depth));
}

TEST_F(RendererDepthGl, TheRightEyeSeesWhatIsBeforeTheTargetFartherLeft) {
  put(ball_block(2.0, 4, 0, {0.0, -8.0, 0.0}));
  const auto parts = viewer::parts_of(camera_, true);
  Picture picture;
  picture.lens = parts[0].camera.lens(content_mm_);
  picture.right_lens = parts[1].camera.lens(content_mm_);
  ASSERT_TRUE(renderer_->draw(picture, screen_->framebuffer(), kWidth, kHeight).ok());
  const viewer::DepthMap right_map = renderer_->read_depth(1);
  const Extent left = clay_extent(renderer_->read_depth(0));
  const Extent right = clay_extent(right_map);
  EXPECT_EQ(right_map.width, kWidth / 2);
  EXPECT_LT(right.left + 2, left.left);
  EXPECT_LT(right.right + 2, left.right);
  EXPECT_NEAR(left.left + right.right, 0.5 * kWidth - 1.0, 1.5);
  EXPECT_TRUE(renderer_->read_depth(2).depth_mm.empty());
}

TEST_F(RendererDepthGl, EachEyeHasTheBallsOwnDepthWhateverMarksTheOtherShows) {
  put(ball_block(kRadiusMm, kSplits));
  Picture picture;
  const auto parts = viewer::parts_of(camera_, true);
  picture.lens = parts[0].camera.lens(content_mm_);
  picture.right_lens = parts[1].camera.lens(content_mm_);
  picture.arrows.push_back({{0.0, -10.0, 0.0}, {0.0, -14.0, 3.0}});
  picture.planes.push_back({{}, {1.0, 0.0, 0.0}, 12.0});
  picture.pins.push_back({{0.0, 0.0, 10.0}});
  ASSERT_TRUE(renderer_->draw(picture, screen_->framebuffer(), kWidth, kHeight).ok());
  for (const viewer::WindowPart& part : parts) {
    const viewer::DepthMap map = renderer_->read_depth(part.eye);
    ASSERT_EQ(map.width, part.camera.width());
    const viewer::Lens lens = part.camera.lens(content_mm_);
    int compared = 0;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const Ray ray = part.ray_at({part.left + x + 0.5, y + 0.5});
        if (!std::isfinite(ball_depth(ray, lens, 0.98 * kRadiusMm))) continue;
        EXPECT_NEAR(depth_at(map, x, y), ball_depth(ray, lens, kRadiusMm), 6.0 * kFlatMm);
        ++compared;
      }
    }
    EXPECT_GT(compared, 3000) << part.eye;
  }
}

}  // namespace
}  // namespace argil::test
