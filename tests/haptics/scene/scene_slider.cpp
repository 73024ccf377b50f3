// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_slider.h"

#include <algorithm>
#include <cmath>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

TEST(Equation3_23to3_27, HeightIsThePrintedSurface) {
  const SliderScene scene;
  EXPECT_NEAR(scene.height_mm(0), 40.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(12.5), 45.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(-12.5), 35.0, 1e-12);
}

TEST(Equation3_23to3_27, DerivativeIsThatOfTheSurface) {
  const SliderScene scene;
  constexpr double kStep = 1e-3;
  double worst = 0.0;
  for (int n = -1000; n <= 1000; ++n) {
    const double y = 0.1 * n;
    const double slope = (scene.height_mm(y + kStep) - scene.height_mm(y - kStep)) / (2.0 * kStep);
    const Vec3 normal = scene.normal_at(y);
    EXPECT_EQ(normal.x, 0.0);
    EXPECT_NEAR(length(normal), 1.0, 1e-15);
    worst = std::max(worst, std::abs(normal.y / normal.z + slope));
  }
  // Relative to the steepest slope, 2 pi f A.
  EXPECT_LE(worst / 0.6283, 1e-6);
  RecordProperty("worst_1e9", std::to_string(worst / 0.6283 * 1e9));
}

TEST(Equation3_23to3_27, ForceIsParallelToTheNormal) {
  const SliderScene scene;
  std::mt19937_64 random(15);
  double worst = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const Vec3 p = random_in_cube(random, 60.0);
    const Vec3 f = force(scene, p, random_in_cube(random, 300.0));
    const Vec3 normal = scene.normal_at(p.y);
    worst = std::max(worst, length(cross(f, normal)));
    ASSERT_GE(dot(f, normal), 0.0);
  }
  EXPECT_LE(worst, 1e-9);
  RecordProperty("worst_1e15", std::to_string(worst * 1e15));
}

TEST(Equation3_23to3_27, SpringIsTheVerticalOffsetProjectedOnTheNormal) {
  const SliderScene scene;
  const Vec3 normal = scene.normal_at(0.0);
  EXPECT_NEAR(normal.z, std::cos(std::atan(0.2 * 3.141592653589793)), 1e-12);
  expect_near(force(scene, {9, 0, 38}), 1.5 * 2.0 * normal.z * normal, 1e-12);
  expect_near(force(scene, {9, -12.5, 33}), {0, 0, 3}, 1e-12);
}

TEST(Equation3_23to3_27, DampsTheNormalVelocityOnlyAndNeverPulls) {
  const SliderScene scene;
  expect_near(force(scene, {0, -12.5, 33}, {300, -70, -100}), {0, 0, 3.5}, 1e-12);
  EXPECT_EQ(force(scene, {0, -12.5, 33}, {0, 0, 1000}), Vec3{});
}

TEST(Equation3_23to3_27, GroovesRunAlongXAndCenterTheHandle) {
  const SliderScene scene;
  EXPECT_EQ(force(scene, {-40, -10, 30}), force(scene, {40, -10, 30}));
  EXPECT_LT(force(scene, {0, -10, 30}).y, 0.0);  // towards the bottom of the groove, -12.5
  EXPECT_GT(force(scene, {0, -15, 30}).y, 0.0);
  EXPECT_EQ(force(scene, {0, -12.5, 35.001}), Vec3{});
}

TEST(Equation3_23to3_27, StiffnessIsTheSlopeAlongTheNormal) {
  const SliderScene scene;
  for (const double y : {0.0, 5.0, -12.5, 30.0}) {
    expect_stiffness_is_the_slope(scene, {0, y, scene.height_mm(y) - 1e-3}, scene.normal_at(y),
                                  1e-3);
  }
  EXPECT_EQ(scene.force_at(at({0, 0, 41})).stiffness_n_per_m, 0.0);
}

TEST(Equation3_23to3_27, IsFiniteForAnyFinitePlace) {
  SliderScene scene;
  expect_finite_everywhere(scene);
}

/// A slider that is never touched, to feel the sphere alone.
ClickOptions sphere_alone() {
  ClickOptions options;
  options.slider.offset_mm = -1000.0;
  return options;
}

TEST(Equation3_28, SphereGives8NewtonAtOneMillimetre) {
  const ClickScene scene(sphere_alone());
  expect_near(force(scene, {0, -20, -6}), {0, 0, 8}, 1e-9);
  expect_near(force(scene, {0, -34, -20}, {500, 500, 500}), {0, -8, 0}, 1e-9);
  EXPECT_EQ(force(scene, {0, -20, -5}), Vec3{});
  EXPECT_EQ(scene.force_at(at({0, -20, -6})).stiffness_n_per_m, 8000.0);
}

TEST(Equation3_28, ButtonStandsOutOfItsGroove) {
  const ClickScene scene;
  const ClickOptions options;
  const SliderScene slider(options.slider);
  // Along the bottom of the groove, y = -12.5: where the sphere ends the slider begins.
  const double top = -20.0 + std::sqrt(15.0 * 15.0 - 7.5 * 7.5);
  EXPECT_NEAR(top - slider.height_mm(-12.5), 4.0, 0.1);
  EXPECT_GT(force(scene, {0, -12.5, top - 0.1}).z, 0.0);
  EXPECT_EQ(force(scene, {0, -12.5, top + 0.001}), Vec3{});
  EXPECT_EQ(force(scene, {20, -12.5, top - 0.1}), Vec3{});
  EXPECT_GT(force(scene, {20, -12.5, slider.height_mm(-12.5) - 0.1}).z, 0.0);
}

TEST(Equation3_28, IsBuriedUnderThePrintedSlider) {
  ClickOptions printed;
  printed.slider.offset_mm = 40.0;
  const ClickScene scene(printed);
  const SliderScene slider(printed.slider);
  // Wherever the sphere begins, the handle is 42 mm deep in the slider already.
  EXPECT_GT(slider.height_mm(-20.0) + 5.0, 42.0);
  EXPECT_EQ(force(scene, {0, -20, -4.999}), force(slider, {0, -20, -4.999}));
}

TEST(Equation3_28, ForcesOfSliderAndSphereAreSummed) {
  const ClickScene both;
  const ClickOptions options;
  const SliderScene slider(options.slider);
  const SphereScene sphere(options.sphere);
  std::mt19937_64 random(16);
  for (int n = 0; n < 10000; ++n) {
    const Vec3 p = Vec3{0, -20, -10} + random_in_cube(random, 15.0);
    const Vec3 v = random_in_cube(random, 100.0);
    expect_near(force(both, p, v), force(slider, p, v) + force(sphere, p, v), 1e-12);
  }
}

TEST(Equation3_28, IsFiniteForAnyFinitePlace) {
  ClickScene scene;
  expect_finite_everywhere(scene);
}

}  // namespace
}  // namespace argil::haptics
