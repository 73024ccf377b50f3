// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_wall.h"

#include <cmath>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

WallOptions of_kind(WallKind kind) {
  WallOptions options;
  options.kind = kind;
  return options;
}

/// Random positions and velocities about the wall: the force along the normal is nowhere negative.
void expect_never_pulls(WallKind kind) {
  std::mt19937_64 random(2);
  WallOptions options = of_kind(kind);
  options.normal = {1, 2, -3};
  options.damping_n_s_per_m = 50.0;
  const WallScene scene(options);
  for (int n = 0; n < 100000; ++n) {
    const Vec3 place = random_in_cube(random, 60.0);
    ASSERT_GE(dot(force(scene, place, random_in_cube(random, 1000.0)), options.normal), 0.0);
  }
}

TEST(Equation3_6, Is20NBelowTheSurfaceAndNoneFromItOn) {
  const WallScene scene(of_kind(WallKind::rigid));
  EXPECT_EQ(force(scene, {3, std::nextafter(-20.0, -21.0), 7}), (Vec3{0, 20, 0}));
  EXPECT_EQ(force(scene, {0, -60, 0}, {0, 500, 0}), (Vec3{0, 20, 0}));
  EXPECT_EQ(force(scene, {0, -20, 0}), Vec3{});
  EXPECT_EQ(force(scene, {0, -19, 0}), Vec3{});
}

TEST(Equation3_6, StiffnessIsALargeNumberInContactOnly) {
  const WallScene scene(of_kind(WallKind::rigid));
  EXPECT_EQ(scene.force_at(at({0, -21, 0})).stiffness_n_per_m, 1e6);
  EXPECT_EQ(scene.force_at(at({0, -20, 0})).stiffness_n_per_m, 0.0);
}

TEST(Equation3_6, IsFiniteForAnyFinitePlace) {
  WallScene scene(of_kind(WallKind::rigid));
  expect_finite_everywhere(scene);
}

TEST(Equation3_7, IsTheSpringPlusTheDamper) {
  const WallScene scene;
  expect_near(force(scene, {5, -25, -5}), {0, 4, 0}, 1e-12);
  expect_near(force(scene, {5, -25, -5}, {30, -100, 70}), {0, 5, 0}, 1e-12);
  expect_near(force(scene, {5, -25, -5}, {30, 100, 70}), {0, 3, 0}, 1e-12);
  EXPECT_EQ(force(scene, {0, -19.999, 0}, {0, -100, 0}), Vec3{});
}

TEST(Equation3_7, TouchesOnTheSurfaceItself) {
  expect_near(force(WallScene(), {0, -20, 0}, {0, -100, 0}), {0, 1, 0}, 1e-12);
}

TEST(Equation3_7, NeverPullsAHandleThatLeaves) {
  EXPECT_EQ(force(WallScene(), {0, -21, 0}, {0, 1000, 0}), Vec3{});
  expect_never_pulls(WallKind::linear);
}

TEST(Equation3_7, PullsAsPrintedWhenTwoSided) {
  WallOptions printed;
  printed.one_sided = false;
  expect_near(force(WallScene(printed), {0, -21, 0}, {0, 1000, 0}), {0, 0.8 - 10.0, 0}, 1e-12);
}

TEST(Equation3_7, StandsAnywhere) {
  WallOptions options;
  options.normal = {0, 0, 4};
  options.offset_mm = 3.0;
  const WallScene scene(options);
  expect_near(force(scene, {9, 9, 1}), {0, 0, 1.6}, 1e-12);
  EXPECT_EQ(force(scene, {9, 9, 3.001}), Vec3{});
}

TEST(Equation3_7, StiffnessIsTheSlope) {
  expect_stiffness_is_the_slope(WallScene(), {0, -25, 0}, {0, 1, 0}, 1e-6);
}

TEST(Equation3_7, IsFiniteForAnyFinitePlace) {
  WallScene scene;
  expect_finite_everywhere(scene);
}

TEST(Equation3_8, DepthIsTheRootOfForceOverStiffness) {
  // 3 N at 1e5 N/m^2: 5.477 mm. Found by halving, as a hand that pushes finds it.
  const WallScene scene(of_kind(WallKind::nonlinear));
  double shallow = 0.0;
  double deep = 100.0;
  for (int n = 0; n < 60; ++n) {
    const double depth = 0.5 * (shallow + deep);
    (force(scene, {0, -20.0 - depth, 0}).y < 3.0 ? shallow : deep) = depth;
  }
  EXPECT_NEAR(deep, 1e3 * std::sqrt(3.0 / 1e5), 1e-9);
  EXPECT_NEAR(deep, 5.48, 0.0548);
  RecordProperty("depth_mm", std::to_string(deep));
}

TEST(Equation3_8, DampingIsThePowerOfTheSpeedAndOpposesIt) {
  const WallScene scene(of_kind(WallKind::nonlinear));
  expect_near(force(scene, {0, -30, 0}, {0, -200, 0}), {0, 10.4, 0}, 1e-12);
  expect_near(force(scene, {0, -30, 0}, {0, 200, 0}), {0, 9.6, 0}, 1e-12);
}

TEST(Equation3_8, WithExponentsOneIsTheLinearWall) {
  WallOptions options = of_kind(WallKind::nonlinear);
  options.depth_exponent = 1.0;
  options.speed_exponent = 1.0;
  options.power_stiffness_n_per_m_to_n = 800.0;
  options.power_damping_n_per_mps_to_m = 10.0;
  const WallScene powers(options);
  const WallScene linear;
  std::mt19937_64 random(3);
  for (int n = 0; n < 10000; ++n) {
    const Vec3 place = random_in_cube(random, 60.0);
    const Vec3 velocity = random_in_cube(random, 1000.0);
    expect_near(force(powers, place, velocity), force(linear, place, velocity), 1e-12);
  }
}

TEST(Equation3_8, NeverPullsAHandleThatLeaves) { expect_never_pulls(WallKind::nonlinear); }

TEST(Equation3_8, StiffnessIsTheSlope) {
  WallOptions options = of_kind(WallKind::nonlinear);
  expect_stiffness_is_the_slope(WallScene(options), {0, -25, 0}, {0, 1, 0}, 1e-6);
  options.depth_exponent = 1.5;
  expect_stiffness_is_the_slope(WallScene(options), {0, -25, 0}, {0, 1, 0}, 1e-6);
  EXPECT_EQ(WallScene(options).force_at(at({0, -20, 0})).stiffness_n_per_m, 0.0);
}

TEST(Equation3_8, IsFiniteForAnyFinitePlace) {
  WallOptions options = of_kind(WallKind::nonlinear);
  options.depth_exponent = 2.5;
  WallScene scene(options);
  expect_finite_everywhere(scene);
}

}  // namespace
}  // namespace argil::haptics
