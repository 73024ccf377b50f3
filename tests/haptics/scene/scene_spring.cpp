// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_spring.h"

#include <algorithm>
#include <cmath>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

TEST(Equation3_1, DrawsToTheCenterInAllDirections) {
  SpringOptions options;
  options.center_mm = {1, 2, 3};
  const SpringScene scene(options);
  expect_near(force(scene, {11, 2, 3}), {-8, 0, 0}, 1e-12);
  expect_near(force(scene, {1, -8, 8}), {0, 8, -4}, 1e-12);
  expect_near(force(scene, {1, 2, 3}), {}, 1e-15);
}

TEST(Equation3_1, DampingOpposesTheVelocity) {
  expect_near(force(SpringScene(), {}, {100, -50, 20}), {-1.0, 0.5, -0.2}, 1e-12);
}

TEST(Equation3_1, FreeOscillationHasNoDamping) {
  SpringOptions free;
  free.damping_n_s_per_m = 0.0;
  const SpringScene scene(free);
  EXPECT_EQ(force(scene, {3, 4, 5}, {100, 200, 300}), force(scene, {3, 4, 5}));
}

TEST(Equation3_1, SlowSweepHasTheSlopeOfTheSpring) {
  // Figure 1: positions of a device with steps of 60 um, 10 mm to either side at 5 mm/s. What is
  // left over is a half step of the spring and the damper, 24 + 50 mN.
  constexpr double kStepMm = 0.06;
  const SpringScene scene;
  double sum_xx = 0.0;
  double sum_xf = 0.0;
  double residual = 0.0;
  for (int n = -2000; n <= 2000; ++n) {
    const double x = 0.005 * n;
    const double f = force(scene, {kStepMm * std::round(x / kStepMm), 0, 0}, {5, 0, 0}).x;
    sum_xx += x * x;
    sum_xf += x * f;
    residual = std::max(residual, std::abs(f + 0.8 * x));
  }
  EXPECT_NEAR(sum_xf / sum_xx * 1e3, -800.0, 4.0);
  EXPECT_LE(residual, 0.024 + 0.050 + 1e-12);
  RecordProperty("slope_n_per_m", std::to_string(sum_xf / sum_xx * 1e3));
  RecordProperty("residual_n", std::to_string(residual));
}

TEST(Equation3_1, StiffnessIsTheSlope) {
  expect_stiffness_is_the_slope(SpringScene(), {3, 0, 0}, {-1, 0, 0}, 1e-6);
  EXPECT_EQ(SpringScene().force_at(at({})).stiffness_n_per_m, 800.0);
}

TEST(Equation3_1, IsFiniteForAnyFinitePlace) {
  SpringScene scene;
  expect_finite_everywhere(scene);
}

}  // namespace
}  // namespace argil::haptics
