// SPDX-License-Identifier: GPL-3.0-or-later
// What the exchange of one window for the next may give the hand.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/force/servo_force.h"

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

constexpr double kToolMm = 2.0;
constexpr double kTickS = 1e-3;

Distance without(Distance clay, const Distance& cut) {
  return [clay = std::move(clay), cut](const Vec3& p) { return std::max(clay(p), -cut(p)); };
}
Distance with(Distance clay, const Distance& added) {
  return [clay = std::move(clay), added](const Vec3& p) { return std::min(clay(p), added(p)); };
}

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) { std::printf("seed %u\n", seed); }
  double between(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  Vec3 point(double half_side_mm) {
    const auto one = [&] { return between(-half_side_mm, half_side_mm); };
    const double x = one();
    const double y = one();
    return {x, y, one()};
  }

 private:
  std::mt19937 random_;
};

/// Whatever is removed, wherever the tool is and goes meanwhile: at an exchange the energy that is
/// felt never rises.
TEST(WindowExchange, RemovingNeverLiftsTheEnergy) {
  Draw draw(1);
  int falls = 0;
  for (int run = 0; run < 20; ++run) {
    WindowChannel channel;
    AnalyticPublisher publisher(channel);
    ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::volume, {0.0, 0.0, 0.0});
    Distance clay = plane({0, 0, 1});
    ForceTool tool = ball_tool(kToolMm, draw.point(1.0));
    publisher.publish(clay, tool);
    servo.tick(tool, kTickS);
    for (int window = 0; window < 6; ++window) {
      const double radius_mm = draw.between(0.5, 3.0);
      clay = without(clay, ball(radius_mm, draw.point(3.0)));
      publisher.publish(clay, tool);
      for (int tick = 0; tick < 6; ++tick) {
        tool.position_mm += draw.point(0.1);
        const double before_nmm = servo.at(tool).energy_nmm;
        servo.begin_tick(tool, kTickS);
        const double after_nmm = servo.at(tool).energy_nmm;
        EXPECT_LE(after_nmm, before_nmm + 1e-6) << run << ' ' << window << ' ' << tick;
        falls += after_nmm < before_nmm - 1e-3 ? 1 : 0;
      }
      // All of the new window is felt then, but for what sums of floats rise by, which is not paid.
      const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
      const Vec3 target_n = lattice.evaluate(servo.window().view(), tool).contact_n;
      EXPECT_LE(length(servo.at(tool).contact_n - target_n), 1e-3);
    }
  }
  EXPECT_GT(falls, 100);
}

/// Clay that is added around a tool which moves all the time: what the exchanges give is within
/// what flowed in and was saved up, at every tick.
TEST(WindowExchange, GivesNoMoreThanItsAccount) {
  Draw draw(2);
  const EnergyAccountOptions account{2.0, 1.0, 3.0};
  constexpr double kShare = 0.3;
  double given_nmm = 0.0;
  double wanted_nmm = 0.0;
  for (int run = 0; run < 10; ++run) {
    WindowChannel channel;
    AnalyticPublisher publisher(channel);
    ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::volume, account);
    Distance clay = plane({0, 0, 1}, -2.0);
    ForceTool tool = ball_tool(kToolMm, {0, 0, 2});
    publisher.publish(clay, tool);
    servo.begin_tick(tool, kTickS, kShare);
    double run_nmm = 0.0;
    double inflow_nmm = kTickS * account.power_mw;
    for (int tick = 0; tick < 60; ++tick) {
      if (tick % 10 == 0) {
        clay = with(clay, ball(draw.between(1.0, 3.0), tool.position_mm + draw.point(1.0)));
        publisher.publish(clay, tool);
      }
      const Vec3 step_mm = draw.point(0.05);
      tool.position_mm += step_mm;
      tool.velocity_mm_per_s = step_mm / kTickS;
      inflow_nmm +=
          kTickS * (account.power_mw + 1e-3 * account.device_damping_n_s_per_m *
                                           dot(tool.velocity_mm_per_s, tool.velocity_mm_per_s));
      const double before_nmm = servo.at(tool).energy_nmm;
      servo.begin_tick(tool, kTickS, kShare);
      const double rise_nmm = kShare * (servo.at(tool).energy_nmm - before_nmm);
      EXPECT_LE(rise_nmm, account.most_nmm + 1e-9);
      run_nmm += std::max(0.0, rise_nmm);
      EXPECT_LE(run_nmm, inflow_nmm + 1e-9) << run << ' ' << tick;
    }
    given_nmm += run_nmm;
    const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
    wanted_nmm += kShare * lattice.evaluate(servo.window().view(), tool).energy_nmm;
  }
  EXPECT_GT(given_nmm, 0.1);
  EXPECT_GT(wanted_nmm, 5.0 * given_nmm) << "the account was never asked for more than it had";
}

/// A hand that presses on into clay whose energy is held back does not fall through: it is borne
/// before it is two radii deeper.
TEST(WindowExchange, BearsAHandThatPressesOn) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::volume, {0.0, 0.0, 0.0});
  const ForceTool tool = ball_tool(kToolMm, {0, 0, 6});
  publisher.publish(plane({0, 0, 1}), tool);
  const double before_n = servo.tick(tool, kTickS).contact_n.z;
  publisher.publish(plane({0, 0, 1}, 7.0), tool);
  for (int tick = 0; tick < 10; ++tick) servo.begin_tick(tool, kTickS);
  EXPECT_LE(servo.at(tool).contact_n.z, 3.0 * before_n + 0.2);
  EXPECT_GT(servo.at(ball_tool(kToolMm, {0, 0, 6.0 - 2.0 * kToolMm})).contact_n.z, 3.0);
}

struct CircleWork {
  double done_nmm = 0.0;    // all the way around
  double turned_nmm = 0.0;  // without its sign
};

CircleWork work_on_circle(const ServoForce& servo) {
  CircleWork work;
  Vec3 last_mm;
  Vec3 last_n;
  constexpr int kSteps = 400;
  for (int n = 0; n <= kSteps; ++n) {
    const double angle = 2.0 * 3.14159265358979 * n / kSteps;
    const Vec3 place{std::cos(angle), 0.6 * std::sin(angle), 0.5 + 0.8 * std::sin(angle)};
    const Vec3 force_n = servo.at(ball_tool(kToolMm, place)).contact_n;
    const double piece_nmm = n > 0 ? 0.5 * dot(force_n + last_n, place - last_mm) : 0.0;
    work.done_nmm += piece_nmm;
    work.turned_nmm += std::abs(piece_nmm);
    last_mm = place;
    last_n = force_n;
  }
  return work;
}

/// In the middle of an exchange, and while energy is held back: no work on a closed path.
TEST(WindowExchange, IsConservativeAtAnyShare) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::volume, {50.0, 1.0, 0.0});
  const ForceTool tool = ball_tool(kToolMm, {0, 0, 1});
  publisher.publish(plane({0, 0, 1}), tool);
  servo.tick(tool, kTickS);
  publisher.publish(with(plane({0, 0, 1}), ball(2.5, {0.5, 0.3, 0.5})), tool);
  for (int tick = 0; tick < 12; ++tick) {
    servo.begin_tick(tool, kTickS);
    if (tick % 4 == 1) {  // between both windows, and on the new one
      const CircleWork work = work_on_circle(servo);
      EXPECT_GT(work.turned_nmm, 1.0);
      EXPECT_LE(std::abs(work.done_nmm), 1e-3 * work.turned_nmm) << tick;
    }
  }
  const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
  EXPECT_LT(servo.at(tool).energy_nmm,
            0.9 * lattice.evaluate(servo.window().view(), tool).energy_nmm);
}

/// A tool that leaves after a rise is neither pulled back nor pushed on where there is no clay.
TEST(WindowExchange, LeavesNoForceInTheAir) {
  for (const double height_mm : {-1.0, 1.0}) {  // lower and higher than what was felt
    WindowChannel channel;
    AnalyticPublisher publisher(channel);
    ForceMaterial material;
    material.skin_mm = 2.0;
    ServoForce servo(channel, material, ForceLaw::energy);
    ForceTool tool = ball_tool(kToolMm, {0, 0, 1});
    constexpr double kMarginMm = 10.0;
    publisher.publish(plane({0, 0, 1}), tool, kMarginMm);
    servo.tick(tool, kTickS);
    publisher.publish(plane({0, 0, 1}, height_mm), tool, kMarginMm);
    servo.tick(tool, kTickS);
    EXPECT_GT(servo.tick(tool, kTickS).contact_n.z, 0.2);
    tool.position_mm.z = 8.0;
    for (int tick = 0; tick < 6; ++tick) {
      const ForceResult felt = servo.tick(tool, kTickS);
      EXPECT_FALSE(felt.outside_window);
      EXPECT_EQ(felt.contact_n, Vec3{}) << tick;
      EXPECT_EQ(felt.energy_nmm, 0.0) << tick;
    }
    // And what comes back on its return is all of the new clay.
    tool.position_mm.z = 1.0;
    const LatticeForce lattice(tool, material, ForceLaw::energy, choose_lattice(tool).voxel_mm);
    EXPECT_EQ(servo.tick(tool, kTickS).contact_n,
              lattice.evaluate(servo.window().view(), tool).contact_n);
  }
}

}  // namespace
}  // namespace argil::haptics
