// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/camera.h"

#include <random>

#include <gtest/gtest.h>

#include "viewer/support/projected.h"

namespace argil::viewer {
namespace {

Camera turned_camera(std::mt19937& random, bool is_parallel) {
  std::uniform_real_distribution<double> pixel(-400.0, 400.0);
  Camera camera;
  camera.resize(1280, 800);
  camera.set_parallel(is_parallel);
  camera.frame({{-20.0, -25.0, -30.0}, {40.0, 25.0, 30.0}});
  camera.orbit(pixel(random), pixel(random));
  camera.pan(0.3 * pixel(random), 0.3 * pixel(random));
  return camera;
}

TEST(CameraProperty, ARayThroughAPixelIsSeenAtThatPixel) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 2000; ++n) {
    const Camera camera = turned_camera(random, n % 2 == 1);
    const Camera::Pixel pixel{1280.0 * share(random), 800.0 * share(random)};
    const Ray ray = camera.ray_at(pixel);
    const double base = camera.is_parallel() ? 100.0 * camera.distance_mm() : 0.0;
    const Vec3 place = ray.origin_mm + (base + 50.0 + 200.0 * share(random)) * ray.direction;
    const Vec3 seen = test::projected(camera, place);
    EXPECT_NEAR(seen.x, pixel.x, 1e-6);
    EXPECT_NEAR(seen.y, pixel.y, 1e-6);
  }
}

TEST(CameraProperty, ZoomKeepsWhatIsUnderThePointer) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 500; ++n) {
    Camera camera = turned_camera(random, n % 2 == 1);
    const Camera::Pixel at{1280.0 * share(random), 800.0 * share(random)};
    const double mm = camera.pixel_mm_at(camera.target_mm());
    const Lens lens = camera.lens({});
    const Vec3 under =
        camera.target_mm() + (at.x - 640.0) * mm * lens.right - (at.y - 400.0) * mm * lens.up;
    camera.zoom(1.0 + share(random), at);
    EXPECT_NEAR(test::projected(camera, under).x, at.x, 1e-6);
    EXPECT_NEAR(test::projected(camera, under).y, at.y, 1e-6);
  }
}

TEST(CameraProperty, FrameShowsEveryCornerAndOrbitNeverStandsOnItsHead) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> pixel(-600.0, 600.0);
  const Box3 box{{-3.0, 1.0, 2.0}, {4.0, 9.0, 5.0}};
  for (int n = 0; n < 500; ++n) {
    Camera camera;
    camera.resize(n % 3 == 0 ? 400 : 1280, 800);
    camera.set_parallel(n % 2 == 1);
    camera.orbit(pixel(random), pixel(random));
    camera.orbit(pixel(random), pixel(random));
    EXPECT_GE(camera.lens(box).up.z, 0.0);
    camera.frame(box);
    for (unsigned c = 0; c < 8; ++c) {
      const Vec3 corner{(c & 1U) != 0 ? box.max.x : box.min.x,
                        (c & 2U) != 0 ? box.max.y : box.min.y,
                        (c & 4U) != 0 ? box.max.z : box.min.z};
      const Vec3 seen = test::projected(camera, corner);
      EXPECT_GE(seen.x, 0.0);
      EXPECT_LE(seen.x, camera.width());
      EXPECT_GE(seen.y, 0.0);
      EXPECT_LE(seen.y, 800.0);
      const Lens lens = camera.lens(box);
      EXPECT_LT(lens.near_mm, seen.z);
      EXPECT_GT(lens.far_mm, seen.z);
    }
  }
}

TEST(Camera, OrbitTurnsByTheWayOfTheHand) {
  Camera camera;
  camera.resize(1000, 800);
  camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
  camera.orbit(500.0, 0.0);  // half the width: a quarter turn
  EXPECT_NEAR(camera.lens({}).back.x, -1.0, 1e-9);
  camera.orbit(0.0, 250.0);  // the hand goes down, so the camera goes up
  EXPECT_NEAR(camera.lens({}).back.z, std::sqrt(0.5), 1e-9);
}

}  // namespace
}  // namespace argil::viewer
