// SPDX-License-Identifier: GPL-3.0-or-later
// Sum or centre: both are the same force where the centre is chosen, and going from one to the
// other is neither felt nor paid by nobody.
#include "argil/haptics/force/point_choice.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/force/servo_force.h"

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

constexpr double kSmallMm = 1.0;  // under the usual skin of 8 mm the centre is often enough
constexpr double kTickSeconds = 1e-3;

/// Flat clay below z = 0 that ends at x = 0 in an edge.
Distance cliff() {
  return [](const Vec3& p) {
    if (p.x > 0.0 && p.z > 0.0) return std::hypot(p.x, p.z);
    return std::max(p.x, p.z);
  };
}

ForceMaterial of_exponent(double exponent) {
  ForceMaterial material;
  material.exponent = exponent;
  return material;
}

TEST(PointEnergyForce, IsMinusTheGradientOfItsEnergy) {
  const Window window = sampled(ball(6.0, {0.3, 0.2, -6.0}), {0, 0, 0}, 3.0, 0.25);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> side(-1.5, 1.5);
  constexpr double kStepMm = 1e-4;
  for (int n = 0; n < 100; ++n) {
    const Vec3 place{side(random), side(random), side(random)};
    const auto at = [&](const Vec3& p) {
      return point_energy_force(window.view, ball_tool(kSmallMm, p), {});
    };
    const ForceResult here = at(place);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = kStepMm;
      const double rise_n =
          (at(place + step).energy_nmm - at(place - step).energy_nmm) / (2.0 * kStepMm);
      EXPECT_NEAR(here.contact_n[axis], -rise_n, 1e-5);
    }
  }
}

/// Wherever it is chosen: the force within 1 %, and within what it says of its own error.
TEST(PointEnergyForce, IsTheSumWhereItIsEnough) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> height(-6.0, 6.0);
  std::uniform_real_distribution<double> along(-8.0, 4.0);
  int chosen = 0;
  for (const Distance& clay : {plane({0.3, 0.2, 0.9}), ball(24.0, {0, 0, -24.0}), cliff()}) {
    for (int n = 0; n < 200; ++n) {
      const ForceMaterial material = of_exponent(n % 2 == 0 ? 1.0 : 2.0);
      const ForceTool tool = ball_tool(kSmallMm, {along(random), along(random), height(random)});
      const Lattice lattice = choose_lattice(tool);
      const Window window =
          sampled(clay, tool.position_mm, window_reach_mm(tool, lattice, 0.0), lattice.voxel_mm);
      if (!is_centre_enough(window.view, tool, material)) continue;
      ++chosen;
      const ForceResult sum = LatticeForce(tool, material, ForceLaw::energy, lattice.voxel_mm)
                                  .evaluate(window.view, tool);
      const ForceResult point = point_energy_force(window.view, tool, material);
      const double off_n = length(point.contact_n - sum.contact_n);
      EXPECT_LE(off_n, 0.011 * length(sum.contact_n)) << n;
      EXPECT_LE(off_n, point.error_n + sum.error_n) << n;
      EXPECT_NEAR(point.stiffness_n_per_mm, sum.stiffness_n_per_mm,
                  0.05 * material.exponent * material.surface_force_n / material.skin_mm);
      EXPECT_EQ(point.samples, 1);
    }
  }
  EXPECT_GT(chosen, 100);
}

/// A servo on one window, `method` as given, its tool led along x a little below the surface.
struct Slide {
  explicit Slide(ForceMethod method) : servo(channel, {}, ForceLaw::energy, method) {
    AnalyticPublisher(channel).publish(cliff(), ball_tool(kSmallMm, {-2.5, 0, -0.2}), 5.0);
  }
  ForceResult at(double x) {
    tool.velocity_mm_per_s = {(x - tool.position_mm.x) / kTickSeconds, 0, 0};
    tool.position_mm.x = x;
    servo.begin_tick(tool, kTickSeconds);
    return servo.at(tool);
  }

  WindowChannel channel;
  ServoForce servo;
  ForceTool tool = ball_tool(kSmallMm, {-7.0, 0, -0.2});
};

/// From flat clay over an edge and back, at 50 mm/s: what is felt is that of the sum alone within
/// the 1 % that a choice may cost, and from tick to tick it changes no more than that and the
/// 5 ms of an exchange allow.
TEST(PointChoice, IsNotFelt) {
  Slide sum(ForceMethod::volume);
  Slide chosen(ForceMethod::automatic);
  int at_centre = 0;
  int exchanges = 0;
  bool was_point = false;
  Vec3 former_off;
  for (int tick = 0; tick < 400; ++tick) {
    const double x = -4.0 - 2.9 * std::cos(2.0 * 3.14159265358979 * tick / 365.0);
    const ForceResult wanted = sum.at(x);
    const ForceResult felt = chosen.at(x);
    const Vec3 off = felt.contact_n - wanted.contact_n;
    const double size_n = length(wanted.contact_n);
    EXPECT_LE(length(off), 0.011 * size_n) << tick;
    EXPECT_LE(length(off - former_off), 0.004 * size_n) << tick;
    former_off = off;
    const bool is_point = felt.samples == 1;
    at_centre += is_point ? 1 : 0;
    exchanges += tick > 0 && is_point != was_point ? 1 : 0;
    was_point = is_point;
  }
  EXPECT_GT(at_centre, 100);
  EXPECT_GE(exchanges, 3);  // to the centre, back at the edge, to the centre again
  EXPECT_LE(exchanges, 4);
}

TEST(PointChoice, DoesNotChatterAtTheBorder) {
  Slide slide(ForceMethod::automatic);
  double border = -7.0;
  for (double x = -7.0; x < 0.0; x += 0.01) {  // where the centre is given up
    const bool was_point = slide.at(x).samples == 1;
    if (was_point) border = x;
  }
  ASSERT_GT(border, -6.0);
  Slide resting(ForceMethod::automatic);
  for (int tick = 0; tick < 100; ++tick) resting.at(border - 1.0);
  ASSERT_EQ(resting.at(border - 1.0).samples, 1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shiver(-0.05, 0.05);
  int exchanges = 0;
  bool was_point = true;
  for (int tick = 0; tick < 2000; ++tick) {
    const bool is_point = resting.at(border + shiver(random)).samples == 1;
    exchanges += is_point != was_point ? 1 : 0;
    was_point = is_point;
  }
  EXPECT_EQ(exchanges, 1);
  EXPECT_FALSE(was_point);
}

/// To and fro over the border for ever: each way back to the sum, which stores a little more than
/// the centre does, is paid by the account.
TEST(PointChoice, GivesNoMoreThanItsAccount) {
  const EnergyAccountOptions account{0.2, 1.0, 0.0};
  WindowChannel channel;
  AnalyticPublisher(channel).publish(cliff(), ball_tool(kSmallMm, {-2.5, 0, -0.2}), 5.0);
  ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::automatic, account);
  ForceTool tool = ball_tool(kSmallMm, {-7.0, 0, -0.2});
  servo.begin_tick(tool, kTickSeconds);
  double inflow_nmm = kTickSeconds * account.power_mw;
  double given_nmm = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    tool.position_mm.x = -4.0 - 2.9 * std::cos(2.0 * 3.14159265358979 * tick / 200.0);
    inflow_nmm += kTickSeconds * account.power_mw;
    const double before_nmm = servo.at(tool).energy_nmm;
    servo.begin_tick(tool, kTickSeconds);
    given_nmm += std::max(0.0, servo.at(tool).energy_nmm - before_nmm);
    ASSERT_LE(given_nmm, inflow_nmm + 1e-6) << tick;
  }
  EXPECT_GT(given_nmm, 0.05) << "sum and centre were never exchanged";
}

/// blanch has no energy that an exchange could be judged by.
TEST(PointChoice, IsForTheEnergyLawAlone) {
  for (const ForceLaw law : {ForceLaw::energy, ForceLaw::blanch}) {
    WindowChannel channel;
    const ForceTool tool = ball_tool(kSmallMm, {0, 0, 0});
    AnalyticPublisher(channel).publish(plane({0, 0, 1}), tool);
    ServoForce servo(channel, {}, law);
    ForceResult felt;
    for (int tick = 0; tick < 100; ++tick) felt = servo.tick(tool, kTickSeconds);
    EXPECT_EQ(felt.samples == 1, law == ForceLaw::energy);
  }
}

/// A slender tool is turned as well.
TEST(PointChoice, IsForBallsAlone) {
  ForceTool slender = ball_tool(0.25, {0, 0, 0});
  slender.radii_mm.z = 1.0;
  const Lattice lattice = choose_lattice(slender);
  const Window window = sampled(plane({0, 0, 1}), {0, 0, 0}, window_reach_mm(slender, lattice, 0.0),
                                lattice.voxel_mm);
  EXPECT_TRUE(point_is_enough(window.view, slender, {}));
  EXPECT_FALSE(is_centre_enough(window.view, slender, {}));
  EXPECT_TRUE(is_centre_enough(window.view, ball_tool(0.25, {0, 0, 0}), {}));
}

}  // namespace
}  // namespace argil::haptics
