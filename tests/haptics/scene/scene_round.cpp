// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_round.h"

#include <algorithm>
#include <cmath>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

TEST(Equation3_9, OneMillimetreDeepIs3NewtonAlongTheRadius) {
  const SphereScene scene;
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const Vec3 radial = normalized(random_in_cube(random, 1.0));
    worst = std::max(worst, length(force(scene, 49.0 * radial) - 3.0 * radial));
  }
  EXPECT_LE(worst, 1e-9);
  RecordProperty("worst_n", std::to_string(worst));
}

TEST(Equation3_9, IsNoughtFromTheSurfaceOn) {
  const SphereScene scene;
  EXPECT_EQ(force(scene, {50, 0, 0}, {-100, 0, 0}), Vec3{});
  EXPECT_EQ(force(scene, {0, -51, 0}), Vec3{});
  EXPECT_EQ(scene.force_at(at({50, 0, 0})).stiffness_n_per_m, 0.0);
}

TEST(Equation3_9, TangentialForceIsZero) {
  const SphereScene scene;
  std::mt19937_64 random(4);
  for (int n = 0; n < 10000; ++n) {
    const Vec3 radial = normalized(random_in_cube(random, 1.0));
    const Vec3 f = force(scene, 48.0 * radial, random_in_cube(random, 100.0));
    ASSERT_LE(length(f - dot(f, radial) * radial), 1e-12);
  }
}

TEST(Equation3_9, DampsTheRadialVelocityOnly) {
  const SphereScene scene;
  expect_near(force(scene, {49, 0, 0}, {-20, 300, -400}), {4, 0, 0}, 1e-12);
  expect_near(force(scene, {49, 0, 0}, {0, 300, -400}), {3, 0, 0}, 1e-12);
}

TEST(Equation3_9, NeverPullsAHandleThatLeaves) {
  EXPECT_EQ(force(SphereScene(), {49, 0, 0}, {200, 0, 0}), Vec3{});
}

TEST(Equation3_9, ThreeNewtonRestOneMillimetreDeep) {
  const SphereScene scene;
  double shallow = 0.0;
  double deep = 10.0;
  for (int n = 0; n < 60; ++n) {
    const double depth = 0.5 * (shallow + deep);
    (force(scene, {0, 0, 50.0 - depth}).z < 3.0 ? shallow : deep) = depth;
  }
  EXPECT_NEAR(deep, 1.0, 1e-9);
}

TEST(Equation3_9, StiffnessIsTheSlope) {
  expect_stiffness_is_the_slope(SphereScene(), {0, 48, 0}, {0, 1, 0}, 1e-6);
}

TEST(Equation3_9, HasNoForceInItsMiddle) { EXPECT_EQ(force(SphereScene(), {}, {9, 9, 9}), Vec3{}); }

TEST(Equation3_9, IsFiniteForAnyFinitePlace) {
  SphereScene scene;
  expect_finite_everywhere(scene);
}

TEST(Equation3_10to3_14, OneMillimetreDeepIs3NewtonOutwards) {
  const CylinderScene scene;
  expect_near(force(scene, {29, 0, 0}), {3, 0, 0}, 1e-9);
  expect_near(force(scene, {0, -29, 40}), {0, -3, 0}, 1e-9);
  EXPECT_EQ(force(scene, {30, 0, 0}, {-100, 0, 0}), Vec3{});
}

TEST(Equation3_10to3_14, HasNoForceOnItsAxis) {
  const CylinderScene scene;
  EXPECT_EQ(force(scene, {}, {10, 20, 30}), Vec3{});
  EXPECT_EQ(force(scene, {0, 0, 33}), Vec3{});
  EXPECT_TRUE(is_finite(force(scene, {5e-324, 0, 0}, {1, 2, 3})));
}

TEST(Equation3_10to3_14, DampsTheRadialVelocityOnly) {
  const CylinderScene scene;
  expect_near(force(scene, {29, 0, 0}, {0, 500, -800}), {3, 0, 0}, 1e-12);
  expect_near(force(scene, {29, 0, 0}, {-20, 500, -800}), {4, 0, 0}, 1e-12);
  EXPECT_EQ(force(scene, {29, 0, 0}, {200, 0, 0}), Vec3{});
}

TEST(Equation3_10to3_14, EndsAtHalfItsHeight) {
  const CylinderScene scene;
  expect_near(force(scene, {29, 0, 50}), {3, 0, 0}, 1e-9);
  EXPECT_EQ(force(scene, {29, 0, 50.001}), Vec3{});
  EXPECT_EQ(force(scene, {29, 0, -50.001}), Vec3{});
}

TEST(Equation3_10to3_14, StandsAnywhere) {
  CylinderOptions options;
  options.center_mm = {10, 20, 30};
  const CylinderScene scene(options);
  expect_near(force(scene, {39, 20, 79}), {3, 0, 0}, 1e-9);
  EXPECT_EQ(force(scene, {39, 20, -21}), Vec3{});
}

TEST(Equation3_10to3_14, StiffnessIsTheSlope) {
  expect_stiffness_is_the_slope(CylinderScene(), {28, 0, 9}, {1, 0, 0}, 1e-6);
}

TEST(Equation3_10to3_14, IsFiniteForAnyFinitePlace) {
  CylinderScene scene;
  expect_finite_everywhere(scene);
}

}  // namespace
}  // namespace argil::haptics
