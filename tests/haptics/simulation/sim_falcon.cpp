// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/sim_falcon.h"

#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

HandPlan still_at(const Vec3& place_mm) {
  HandKey key;
  key.place_mm = place_mm;
  return HandPlan({key});
}

FalconModel exact_model() {
  FalconModel model = frictionless_falcon();
  model.encoder = Encoder::exact;
  return model;
}

TEST(SimFalcon, OscillatesAsTheExactSolution) {
  // A hand is a spring and a damper: held by one that lets it swing, the motion has a closed form.
  const FalconModel model = exact_model();
  HandModel spring;
  spring.stiffness_n_per_m = 800.0;
  HandKey key;
  key.place_mm = {11.0, 0.0, 0.0};
  HandKey moved;
  moved.time_s = 1e-9;  // the position jumps to the middle: from here on it swings freely
  SimFalcon device(model, spring, HandPlan({key, moved}));
  const double rate = 0.5 * model.damping_n_s_per_m / model.mass_kg;
  const double omega = std::sqrt(800.0 / model.mass_kg - rate * rate);
  for (int n = 0; n <= 1000; ++n) {
    const double t = 1e-3 * n;
    const double x = device.read(t).position_mm.x;
    const double exact =
        11.0 * std::exp(-rate * t) * (std::cos(omega * t) + rate / omega * std::sin(omega * t));
    ASSERT_NEAR(x, exact, 11.0 * 1e-4) << t;
  }
}

TEST(SimFalcon, StaysWhereFrictionHoldsIt) {
  FalconModel model;
  model.delay_ticks = 0;
  SimFalcon device(model, {}, still_at({}));
  for (int n = 0; n < 1000; ++n) {
    device.read(1e-3 * n);
    device.write({0.149, 0.0, 0.0});
  }
  EXPECT_EQ(device.true_position_mm(), Vec3{});
  for (int n = 1000; n < 2000; ++n) {
    device.read(1e-3 * n);
    device.write({0.3, 0.0, 0.0});
  }
  // 0.15 N against 3 N s/m: 50 mm/s once it has settled
  EXPECT_NEAR(device.true_velocity_mm_per_s().x, 50.0, 1.0);
}

TEST(SimFalcon, HoldsAForceForATickAfterItsDelay) {
  for (int delay = 0; delay <= 3; ++delay) {
    FalconModel model;
    model.delay_ticks = delay;
    SimFalcon device(model, {}, still_at({}));
    for (int n = 0; n < 6; ++n) {
      device.read(1e-3 * n);
      device.write({n == 0 ? 1.0 : 0.0, 0.0, 0.0});
      EXPECT_EQ(device.held_force_n().x, n == delay ? 1.0 : 0.0) << delay << " " << n;
    }
  }
}

TEST(SimFalcon, SaturatesAndKeepsTheDirection) {
  FalconModel model;
  model.delay_ticks = 0;
  SimFalcon device(model, {}, still_at({}));
  device.read(0.0);
  device.write({30.0, 40.0, 0.0});
  EXPECT_NEAR(device.held_force_n().x, 5.4, 1e-12);
  EXPECT_NEAR(device.held_force_n().y, 7.2, 1e-12);
}

TEST(SimFalcon, ReadsMultiplesOfItsQuantum) {
  FalconModel model;
  model.encoder = Encoder::uniform;
  SimFalcon device(model, hand_model(Hand::light), HandPlan({HandKey{}, [] {
                                                               HandKey key;
                                                               key.time_s = 1.0;
                                                               key.place_mm = {5.0, -3.0, 2.0};
                                                               return key;
                                                             }()}));
  const Vec3 first = device.read(0.0).position_mm;
  for (int n = 1; n < 1000; ++n) {
    const DeviceReading reading = device.read(1e-3 * n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double quanta = (reading.position_mm[axis] - first[axis]) / 0.06;
      ASSERT_NEAR(quanta, std::round(quanta), 1e-6);
      ASSERT_LE(std::abs(reading.position_mm[axis] - device.true_position_mm()[axis]), 0.03 + 1e-9);
    }
  }
}

TEST(SimFalcon, ReadsWholeCountsOfItsArms) {
  const FalconModel model;  // kinematic
  HandKey far;
  far.time_s = 1.0;
  far.place_mm = {25.0, -20.0, 22.0};
  SimFalcon device(model, hand_model(Hand::firm), HandPlan({HandKey{}, far}));
  const FalconKinematics arms(martin_hillier_geometry());
  const auto counts_at = [&](const Vec3& place) {
    return arms.ticks_of_angles(*arms.angles_of(place + kFalconCenterMm));
  };
  const LegValues first = counts_at(device.read(0.0).position_mm);
  double worst_mm = 0.0;
  for (int n = 1; n < 1500; ++n) {
    const Vec3 read = device.read(1e-3 * n).position_mm;
    const LegValues counts = counts_at(read);
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double moved = counts[leg] - first[leg];
      ASSERT_NEAR(moved, std::round(moved), 1e-6) << n;
    }
    worst_mm = std::max(worst_mm, length(read - device.true_position_mm()));
  }
  EXPECT_GT(worst_mm, 0.01);
  EXPECT_LT(worst_mm, 0.06);  // half a count of each arm
}

TEST(SimFalcon, PressesWithTheForceMeant) {
  // Against a wall that does not give, at rest, every hand presses what the plan says.
  for (const Hand hand : {Hand::light, Hand::arm, Hand::firm, Hand::push}) {
    FalconModel model = exact_model();
    model.delay_ticks = 0;
    HandKey key;
    key.press_n = 3.0;
    SimFalcon device(model, hand_model(hand), HandPlan({key}));
    double force = 0.0;
    for (int n = 0; n < 40'000; ++n) {
      const double y = device.read(1e-4 * n).position_mm.y;
      force = -0.5 * y;  // 500 N/m about the position itself
      device.write({0.0, force, 0.0});
    }
    // the spring of the hand meets the wall's: it rests a little deeper and presses a little less
    const double hand_k = hand == Hand::push ? 0.0 : hand_model(hand).stiffness_n_per_m;
    EXPECT_NEAR(force, 3.0 * 500.0 / (500.0 + hand_k), 0.01) << hand_model(hand).name;
  }
}

TEST(SimFalcon, GivesTheSameBitsForTheSameSeed) {
  const auto run = [](std::uint64_t seed) {
    FalconModel model;
    model.jitter_counts = 1.0;
    model.seed = seed;
    HandKey key;
    key.press_n = 1.0;
    SimFalcon device(model, hand_model(Hand::arm), HandPlan({key}));
    std::vector<double> seen;
    for (int n = 0; n < 500; ++n) {
      const DeviceReading reading = device.read(1e-3 * n);
      seen.push_back(reading.position_mm.y);
      device.write({0.0, -0.1 * reading.position_mm.y, 0.0});
    }
    return seen;
  };
  EXPECT_EQ(run(7), run(7));
  EXPECT_NE(run(7), run(8));
}

TEST(SimFalcon, IsNotReadyWhileUnplugged) {
  SimFalcon device({}, hand_model(Hand::arm), still_at({}));
  EXPECT_TRUE(device.read(0.0).is_ready);
  device.set_plugged(false);
  EXPECT_FALSE(device.read(1e-3).is_ready);
  device.write({5.0, 0.0, 0.0});
  EXPECT_EQ(device.held_force_n(), Vec3{});
  device.set_plugged(true);
  EXPECT_TRUE(device.read(2e-3).is_ready);
}

TEST(SimFalcon, LosesNoMoreThanATenthOfASecond) {
  // A servo that was away for a second must not find the handle on the moon.
  SimFalcon device(exact_model(), {}, still_at({}));
  device.read(0.0);
  device.write({9.0, 0.0, 0.0});
  device.read(1e-3);
  device.write({9.0, 0.0, 0.0});
  device.read(1.0);
  EXPECT_LT(device.true_position_mm().x, 100.0);
}

}  // namespace
}  // namespace argil::haptics
