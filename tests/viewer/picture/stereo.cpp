// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/stereo.h"

#include <random>

#include <gtest/gtest.h>

#include "viewer/support/projected.h"

namespace argil::viewer {
namespace {

Camera some_camera(std::mt19937& random, int width, bool is_parallel) {
  std::uniform_real_distribution<double> pixel(-400.0, 400.0);
  Camera camera;
  camera.resize(width, 600);
  camera.set_parallel(is_parallel);
  camera.frame({{-20.0, -25.0, -30.0}, {40.0, 25.0, 30.0}});
  camera.orbit(pixel(random), pixel(random));
  camera.pan(0.3 * pixel(random), 0.3 * pixel(random));
  return camera;
}

TEST(StereoProperty, APixelOfAHalfIsWhatItsEyeSees) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 1000; ++n) {
    const int width = 800 + n % 3;  // odd ones too
    const Camera camera = some_camera(random, width, n % 2 == 1);
    const Camera::Pixel pixel{width * share(random), 600.0 * share(random)};
    const WindowPart part = part_at(camera, true, pixel);
    const int left_half = width / 2;
    EXPECT_EQ(part.eye, pixel.x < left_half ? 0U : 1U);
    const Ray ray = part.ray_at(pixel);
    const double base = camera.is_parallel() ? 100.0 * camera.distance_mm() : 0.0;
    const Vec3 place = ray.origin_mm + (base + 50.0 + 200.0 * share(random)) * ray.direction;
    const Vec3 seen = test::projected(part.camera, place);
    EXPECT_NEAR(part.left + seen.x, pixel.x, 1e-6);
    EXPECT_NEAR(seen.y, pixel.y, 1e-6);
  }
}

TEST(StereoProperty, ZoomKeepsWhatIsUnderThePointerInEachHalf) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 500; ++n) {
    Camera camera = some_camera(random, 801, n % 2 == 1);
    const Camera::Pixel at{801.0 * share(random), 600.0 * share(random)};
    const Ray ray = part_at(camera, true, at).ray_at(at);
    const Vec3 back = camera.lens({}).back;
    const Vec3 under = ray.origin_mm + dot(camera.target_mm() - ray.origin_mm, back) /
                                           dot(ray.direction, back) * ray.direction;
    camera.zoom(1.0 + share(random), between_eyes(camera, true, at));
    const WindowPart part = part_at(camera, true, at);
    const Vec3 seen = test::projected(part.camera, under);
    EXPECT_NEAR(part.left + seen.x, at.x, 1e-6);
    EXPECT_NEAR(seen.y, at.y, 1e-6);
  }
}

TEST(Stereo, EyesLookAtTheTargetFromBothSides) {
  std::mt19937 random(19);
  const Camera camera = some_camera(random, 801, false);
  const auto parts = parts_of(camera, true);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].camera.width() + parts[1].camera.width(), 801);
  EXPECT_EQ(parts[1].left, parts[0].camera.width());
  const Lens middle = camera.lens({});
  for (const WindowPart& part : parts) {
    const Vec3 seen = test::projected(part.camera, camera.target_mm());
    EXPECT_NEAR(seen.x, 0.5 * part.camera.width(), 1e-9);
    EXPECT_NEAR(seen.y, 300.0, 1e-9);
    const Vec3 moved = part.camera.lens({}).eye_mm - middle.eye_mm;
    const double side = part.eye == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(dot(moved, middle.right), 0.03 * side * camera.distance_mm(), 1e-9);
    EXPECT_NEAR(length(moved), 0.03 * camera.distance_mm(), 1e-9);
  }
}

TEST(Stereo, WithoutItThereIsOnePictureAndItsPixelsAreTheWindows) {
  std::mt19937 random(20);
  const Camera camera = some_camera(random, 801, false);
  ASSERT_EQ(parts_of(camera, false).size(), 1U);
  const WindowPart part = part_at(camera, false, {700.0, 20.0});
  EXPECT_EQ(part.eye, 0U);
  EXPECT_EQ(part.left, 0);
  EXPECT_EQ(part.camera.lens({}), camera.lens({}));
  EXPECT_EQ(between_eyes(camera, false, {700.0, 20.0}).x, 700.0);
}

TEST(Stereo, FramesABoxInEachHalf) {
  const Box3 box{{-30.0, -5.0, -10.0}, {30.0, 5.0, 10.0}};  // wider than half a window
  Camera camera;
  camera.resize(801, 600);
  frame_in_each(camera, true, box);
  EXPECT_EQ(camera.width(), 801);
  for (const WindowPart& part : parts_of(camera, true)) {
    for (unsigned c = 0; c < 8; ++c) {
      const Vec3 corner{(c & 1U) != 0 ? box.max.x : box.min.x,
                        (c & 2U) != 0 ? box.max.y : box.min.y,
                        (c & 4U) != 0 ? box.max.z : box.min.z};
      const Vec3 seen = test::projected(part.camera, corner);
      EXPECT_GE(seen.x, 0.0);
      EXPECT_LE(seen.x, part.camera.width());
    }
  }
  const double in_stereo = camera.distance_mm();
  frame_in_each(camera, false, box);
  EXPECT_LT(camera.distance_mm(), 0.7 * in_stereo);
}

TEST(Stereo, FramesABoxWithinWhatPanelsLeaveFree) {
  const Box3 box{{-30.0, -5.0, -30.0}, {30.0, 5.0, 30.0}};
  const FreeRoom room{150.0, 20.0, 1060.0, 700.0};
  for (const bool is_stereo : {false, true}) {
    Camera camera;
    camera.resize(1280, 720);
    frame_in_each(camera, is_stereo, box, room);
    EXPECT_EQ(camera.target_mm(), box.center());  // about which the view turns
    for (const WindowPart& part : parts_of(camera, is_stereo)) {
      for (unsigned c = 0; c < 8; ++c) {
        const Vec3 corner{(c & 1U) != 0 ? box.max.x : box.min.x,
                          (c & 2U) != 0 ? box.max.y : box.min.y,
                          (c & 4U) != 0 ? box.max.z : box.min.z};
        const Vec3 seen = test::projected(part.camera, corner);
        EXPECT_GE(part.left + seen.x, room.left);
        EXPECT_LE(part.left + seen.x, room.right);
        EXPECT_GE(seen.y, room.top);
        EXPECT_LE(seen.y, room.bottom);
      }
    }
    // Not smaller than that asks for, unless panels leave next to nothing.
    Camera whole = camera;
    frame_in_each(whole, is_stereo, box);
    EXPECT_GT(camera.distance_mm(), 1.05 * whole.distance_mm());
    frame_in_each(camera, is_stereo, box, FreeRoom{639.0, 20.0, 641.0, 700.0});
    EXPECT_LT(camera.distance_mm(), 5.0 * whole.distance_mm());
  }
}

}  // namespace
}  // namespace argil::viewer
