// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_vibro.h"

#include <algorithm>
#include <cmath>

#include "argil/haptics/scene/scene_round.h"
#include "argil/haptics/scene/scene_wall.h"

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

/// What the vibration adds along y while the handle goes through `ticks` steps over a wall.
struct Felt {
  double least_n = 0.0;
  double most_n = 0.0;
  int rises = 0;  ///< times it went from below to above zero
};
Felt slide(VibroScene& scene, const ForceScene& wall, Vec3 from, const Vec3& step, int ticks) {
  Felt felt;
  double last = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const HandleState handle = at(from);
    scene.begin_tick(handle);
    const double added = scene.force_at(handle).force_n.y - wall.force_at(handle).force_n.y;
    felt.rises += last < 0.0 && added >= 0.0 ? 1 : 0;
    felt.least_n = std::min(felt.least_n, added);
    felt.most_n = std::max(felt.most_n, added);
    last = added;
    from += step;
  }
  return felt;
}

TEST(Section3_6_4, VibratesWithSpeedOverWavelength) {
  WallScene wall;
  for (const double speed_mm_per_s : {10.0, 50.0, 200.0}) {
    VibroScene scene(wall);
    const Vec3 step = normalized(Vec3{3, 0, -4}) * (speed_mm_per_s / 1e3);
    const Felt felt = slide(scene, wall, {-50, -21, 50}, step, 2000);
    EXPECT_NEAR(felt.rises / 2.0, speed_mm_per_s, 1.0);
    EXPECT_NEAR(felt.most_n, 0.1, 0.005);
    EXPECT_NEAR(felt.least_n, -0.1, 0.005);
  }
}

TEST(Section3_6_4, DoesNotVibrateWithoutSliding) {
  WallScene wall;
  VibroScene scene(wall);
  // Pressed in and out, and at rest with an encoder that flips by a step of 0.06 mm.
  slide(scene, wall, {0, -21, 0}, {0, -0.01, 0}, 1000);
  EXPECT_EQ(scene.phase(), 0.0);
  for (int n = 0; n < 1000; ++n) {
    scene.begin_tick(at({n % 2 == 0 ? 0.0 : 0.06, -30.99, 0}));
  }
  EXPECT_EQ(scene.phase(), 0.0);
}

TEST(Section3_6_4, ChangesNothingOffTheSurface) {
  WallScene wall;
  VibroScene scene(wall);
  const Felt felt = slide(scene, wall, {-50, -19.9, 0}, {0.05, 0, 0}, 2000);
  EXPECT_EQ(felt.most_n, 0.0);
  EXPECT_EQ(felt.least_n, 0.0);
  EXPECT_EQ(scene.phase(), 0.0);
}

TEST(Section3_6_4, VibrationIsNeverMoreThanTheForce) {
  WallScene wall;
  VibroScene scene(wall);
  // 0.05 mm deep the wall gives 0.04 N.
  const Felt felt = slide(scene, wall, {-50, -20.05, 0}, {0.05, 0, 0}, 2000);
  EXPECT_GT(felt.most_n, 0.03);
  EXPECT_LE(felt.most_n, 0.04 + 1e-12);
  EXPECT_GE(felt.least_n, -0.04 - 1e-12);
}

TEST(Section3_6_4, VibrationIsAlongTheForceAndTheSameWithinATick) {
  SphereOptions options;
  options.damping_n_s_per_m = 0.0;
  SphereScene sphere(options);
  VibroScene scene(sphere);
  for (int n = 0; n < 500; ++n) {
    const double angle = 1e-3 * n;
    const HandleState handle = at({49.0 * std::cos(angle), 49.0 * std::sin(angle), 0});
    scene.begin_tick(handle);
    const Vec3 first = scene.force_at(handle).force_n;
    ASSERT_EQ(scene.force_at(handle).force_n, first);
    ASSERT_LE(length(cross(first, handle.position_mm)), 1e-9);
  }
  EXPECT_GT(scene.phase(), 0.0);
}

TEST(Section3_6_4, VibroKeepsWhatTheOtherSceneReports) {
  WallScene wall;
  const VibroScene scene(wall);
  EXPECT_EQ(scene.most_queries(), wall.most_queries() - 1);
  EXPECT_EQ(scene.force_at(at({0, -21, 0})).stiffness_n_per_m, 800.0);
}

TEST(Section3_6_4, VibroIsFiniteForAnyFinitePlace) {
  SphereScene sphere;
  VibroScene round(sphere);
  expect_finite_everywhere(round);
  WallScene wall;
  VibroScene flat(wall);
  expect_finite_everywhere(flat);
}

}  // namespace
}  // namespace argil::haptics
