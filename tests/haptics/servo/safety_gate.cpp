// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/safety_gate.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

/// A gate that has ramped in to a force.
SafetyGate gate_at(const Vec3& force_n) {
  SafetyGate gate({});
  for (int n = 0; n < 1000; ++n) {
    std::uint32_t faults = kServoSound;
    gate.limit(force_n, faults, kTickS);
  }
  return gate;
}

Vec3 gate_tick(SafetyGate& gate, const Vec3& force_n, std::uint32_t faults = kServoSound) {
  return gate.limit(force_n, faults, kTickS);
}

TEST(SafetyGate, RampsInAtTheStart) {
  SafetyGate gate({});
  double before = 0.0;
  for (int n = 1; n <= 600; ++n) {
    const Vec3 force = gate_tick(gate, {0.0, 3.0, 0.0});
    EXPECT_LE(force.y - before, 3.0 * kTickS / 0.5 + 1e-12);
    EXPECT_GE(force.y, before);
    before = force.y;
  }
  EXPECT_DOUBLE_EQ(before, 3.0);
}

TEST(SafetyGate, PassesASoundForceUnchanged) {
  SafetyGate gate = gate_at({1.0, 2.0, 3.0});
  std::uint32_t faults = kServoSound;
  EXPECT_EQ(gate.limit({1.0, 2.0, 3.0}, faults, kTickS), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(faults, kServoSound);
}

TEST(SafetyGate, LimitsTheMagnitudeAndKeepsTheDirection) {
  SafetyGate gate = gate_at({12.0, 16.0, 0.0});
  std::uint32_t faults = kServoSound;
  const Vec3 force = gate.limit({12.0, 16.0, 0.0}, faults, kTickS);
  EXPECT_NEAR(length(force), 8.0, 1e-12);
  EXPECT_NEAR(force.x / force.y, 0.75, 1e-12);
  EXPECT_EQ(faults, kForceLimited);
}

TEST(SafetyGate, LimitsTheSlew) {
  SafetyGate gate = gate_at({});
  std::uint32_t faults = kServoSound;
  EXPECT_NEAR(length(gate.limit({0.0, 8.0, 0.0}, faults, kTickS)), 2.0, 1e-12);
  EXPECT_EQ(faults, kSlewLimited);
}

TEST(SafetyGate, CutsToZeroAtOnceAndRampsInAgain) {
  for (const std::uint32_t fault : {kForceNotFinite, kDeviceLost, kClockJumped, kStopping}) {
    SafetyGate gate = gate_at({0.0, 3.0, 0.0});
    EXPECT_EQ(gate_tick(gate, {0.0, 3.0, 0.0}, fault), Vec3{}) << fault;
    const Vec3 after = gate_tick(gate, {0.0, 3.0, 0.0});
    EXPECT_GT(after.y, 0.0);
    EXPECT_LE(after.y, 3.0 * kTickS / 0.5 + 1e-12) << fault;
  }
}

TEST(SafetyGate, TurnsWhatIsNoNumberIntoZeroAndAFault) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec3& bad : {Vec3{nan, 0.0, 0.0}, Vec3{0.0, inf, 0.0}, Vec3{0.0, 0.0, -inf}}) {
    SafetyGate gate = gate_at({0.0, 3.0, 0.0});
    std::uint32_t faults = kServoSound;
    EXPECT_EQ(gate.limit(bad, faults, kTickS), Vec3{});
    EXPECT_EQ(faults, kForceNotFinite);
  }
}

TEST(SafetyGate, RampsOutTheLastGoodForceOnAStaleWindow) {
  SafetyGate gate = gate_at({0.0, 3.0, 0.0});
  double before = 3.0;
  for (int n = 1; n <= 20; ++n) {
    // What the scene says while it knows nothing does not count.
    const Vec3 force = gate_tick(gate, {0.0, -5.0, 0.0}, kWindowStale);
    EXPECT_LT(force.y, before);
    EXPECT_GE(force.y, before - 2.0);
    before = force.y;
  }
  EXPECT_NEAR(before, 0.0, 1e-12);
  EXPECT_EQ(gate_tick(gate, {0.0, -5.0, 0.0}, kWindowStale), Vec3{});
}

TEST(SafetyGateProperty, WhateverComesInStaysWithinTheLimits) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::uniform_int_distribution<int> kind(0, 19);
  const SafetyOptions options;
  SafetyGate gate(options);
  Vec3 before;
  for (int n = 0; n < 200'000; ++n) {
    Vec3 force = std::pow(10.0, 4.0 * any(random)) * Vec3{any(random), any(random), any(random)};
    if (kind(random) == 0) force.x = std::numeric_limits<double>::quiet_NaN();
    std::uint32_t faults = kind(random) == 0 ? 1U << static_cast<unsigned>(kind(random) % 7) : 0U;
    const double period = kind(random) == 0 ? 0.0 : 1e-3 * (1.0 + any(random));
    const Vec3 given = gate.limit(force, faults, period);
    ASSERT_TRUE(is_finite(given));
    ASSERT_LE(length(given), options.most_force_n * (1.0 + 1e-12));
    if ((faults & kCutFaults) != 0) {
      ASSERT_EQ(given, Vec3{});
    } else {
      ASSERT_LE(length(given - before), options.most_slew_n_per_s * period + 1e-12);
    }
    before = given;
  }
}

TEST(SafetyGate, SaysWhyForEveryFault) {
  for (unsigned bit = 0; bit <= 11; ++bit) {
    EXPECT_STRNE(fault_text(1U << bit), "") << bit;
  }
  EXPECT_STREQ(fault_text(kServoSound), "");
}

}  // namespace
}  // namespace argil::haptics
