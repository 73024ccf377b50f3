// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/adaptive_damping.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/servo/recording.h"

#include "haptics/servo/loop_scenes.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

constexpr DeviceTraits kDampedFalcon{0.4589, 3.0, 9.0, 1e-3, 0.06};

DampingOptions adaptive_options() {
  DampingOptions options;
  options.kind = DampingKind::adaptive;
  return options;
}

/// The handle swings at 10 Hz by 20 mm with this zeta, the contact pushing along y all the while.
double added_after(AdaptiveDamping& damping, double zeta, double seconds, double most) {
  constexpr double kOmega = 2.0 * std::numbers::pi * 10.0;
  Vec3 before{0.0, 20.0, 0.0};
  for (double t = 0.0; t < seconds; t += kTickS) {
    const Vec3 at{0.0, 20.0 * std::exp(-zeta * kOmega * t) * std::cos(kOmega * t), 0.0};
    damping.tick({0.0, 3.0, 0.0}, at - before, (at - before) / kTickS, kTickS, most);
    before = at;
  }
  return damping.added_n_s_per_m();
}

TEST(AdaptiveDampingBound, IsWhatTheLoopAndTheCountsAllow) {
  DampingOptions options = adaptive_options();
  options.most_count_n = 1.5;
  // 2 c Delta / (T + lag) = 1.5 N
  EXPECT_NEAR(most_added_damping_n_s_per_m(options, kDampedFalcon, 1e-3, 3e-3), 50.0, 1e-9);
  EXPECT_NEAR(most_added_damping_n_s_per_m(options, kDampedFalcon, 1e-3, 0.0), 12.5, 1e-9);
  DeviceTraits fine = kDampedFalcon;
  fine.quantum_mm = 0.0;
  // Half of 0.83 m / T, the exact limit of raw velocities with a tick of delay, to 5 %.
  EXPECT_NEAR(most_added_damping_n_s_per_m(options, fine, 1e-3, 0.0), 0.5 * 0.83 * 458.9, 10.5);
  fine.delay_s = 5e-3;
  EXPECT_NEAR(most_added_damping_n_s_per_m(options, fine, 5e-3, 3e-3), 27.7, 0.1);
}

TEST(AdaptiveDamping, AddsWhatASwingLacks) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  // Two strokes: 2 m omega (0.3 - zeta).
  const double once = 2.0 * 0.4589 * 20.0 * std::numbers::pi * (0.3 - 0.05);
  EXPECT_NEAR(added_after(damping, 0.05, 0.16, 1e3), once, 0.03 * once);
  // The swing here knows nothing of what is added, and asks for it again.
  EXPECT_GT(added_after(damping, 0.05, 0.3, 1e3), 1.5 * once);
}

TEST(AdaptiveDamping, TakesAwayWhatASwingHasTooMuchOf) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  const double before = added_after(damping, 0.0, 0.3, 40.0);
  EXPECT_EQ(before, 40.0);
  EXPECT_LT(added_after(damping, 0.45, 0.16, 40.0), before);
}

TEST(AdaptiveDamping, AddsNothingInFreeMotion) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  for (int n = 0; n < 10'000; ++n) {
    const Vec3 moved{0.0, 0.5 * std::cos(0.06 * n), 0.0};
    EXPECT_EQ(damping.tick({}, moved, moved / kTickS, kTickS, 50.0), Vec3{});
    EXPECT_EQ(damping.added_n_s_per_m(), 0.0);
  }
}

/// Sliding is across the contact's force, however it swings.
TEST(AdaptiveDamping, AddsNothingToASlide) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  for (int n = 0; n < 10'000; ++n) {
    const Vec3 moved{0.5 * std::cos(0.06 * n), 0.0, 0.0};
    const Vec3 force_n = damping.tick({0.0, 3.0, 0.0}, moved, moved / kTickS, kTickS, 50.0);
    ASSERT_EQ(force_n, (Vec3{0.0, 3.0, 0.0}));
  }
  EXPECT_EQ(damping.added_n_s_per_m(), 0.0);
}

/// A hold at the edge of a count.
TEST(AdaptiveDamping, AddsNothingToACountThatComesAndGoes) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  for (int n = 0; n < 10'000; ++n) {
    const Vec3 moved{0.0, n / 30 % 2 == 0 ? 0.06 : -0.06, 0.0};
    const bool flips = n % 30 == 0;
    const Vec3 force_n =
        damping.tick({0.0, 3.0, 0.0}, flips ? moved : Vec3{}, moved / kTickS, kTickS, 50.0);
    ASSERT_EQ(force_n, (Vec3{0.0, 3.0, 0.0}));
  }
  EXPECT_EQ(damping.added_n_s_per_m(), 0.0);
}

TEST(AdaptiveDamping, LetsGoOfASwingThatIsOver) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  const double before = added_after(damping, 0.0, 0.3, 40.0);
  const auto rest_for = [&](double seconds, const Vec3& force_n) {
    for (double t = 0.0; t < seconds; t += kTickS) damping.tick(force_n, {}, {}, kTickS, 40.0);
    return damping.added_n_s_per_m();
  };
  EXPECT_LT(rest_for(1.2, {0.0, 3.0, 0.0}), 0.5 * before);
  EXPECT_EQ(rest_for(20.0, {0.0, 3.0, 0.0}), 0.0);
  // And at once off the surface.
  added_after(damping, 0.0, 0.3, 40.0);
  EXPECT_EQ(rest_for(0.2, {}), 0.0);
}

TEST(AdaptiveDamping, ForgetsWhenItIsReset) {
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  added_after(damping, 0.0, 0.3, 40.0);
  damping.reset();
  EXPECT_EQ(damping.added_n_s_per_m(), 0.0);
  EXPECT_EQ(damping.tick({0.0, 3.0, 0.0}, {}, {0.0, 90.0, 0.0}, kTickS, 40.0), (Vec3{0, 3, 0}));
}

/// Whatever comes: within the bounds, along the contact, against the velocity and never a pull.
TEST(AdaptiveDampingProperty, StaysWithinItsBoundsAndOpposesTheVelocity) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto vector = [&](double size) {
    return Vec3{uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  };
  AdaptiveDamping damping(adaptive_options(), kDampedFalcon);
  double seen = 0.0;
  Vec3 push;
  double omega = 60.0;
  for (int n = 0; n < 1'000'000; ++n) {
    // Swings of all kinds, with noise, pauses, jumps and other contacts between.
    if (n % 500 == 0) {
      omega = uniform(5.0, 600.0);
      push = uniform(0.0, 1.0) < 0.2 ? Vec3{} : vector(9.0);
    }
    const double period_s = uniform(0.25e-3, 20e-3);
    const Vec3 moved = length(push) > 0.0
                           ? uniform(0.0, 3.0) * std::cos(omega * 1e-3 * n) * normalized(push)
                           : vector(3.0);
    const Vec3 velocity = n % 7 == 0 ? vector(2e3) : moved / period_s;
    const Vec3 force_n = n % 11 == 0 ? vector(9.0) : push;
    const double most = uniform(0.0, 80.0);
    const Vec3 given_n = damping.tick(force_n, moved, velocity, period_s, most);
    const double added = damping.added_n_s_per_m();
    ASSERT_GE(added, 0.0) << n;
    ASSERT_LE(added, most) << n;
    const Vec3 drag_n = given_n - force_n;
    ASSERT_LE(length(drag_n), 1e-3 * added * length(velocity) * (1.0 + 1e-9) + 1e-9) << n;
    ASSERT_LE(dot(drag_n, velocity), 1e-9 * length(velocity)) << n;
    ASSERT_GE(dot(given_n, force_n), 0.0) << n;
    ASSERT_LE(length(cross(given_n, force_n)), 1e-9 * dot(force_n, force_n) + 1e-9) << n;
    seen = std::max(seen, added);
  }
  EXPECT_GT(seen, 40.0) << "nothing was bounded";
}

HoldTestResult held_wall(Hand hand, double n_per_m, DampingKind kind, ServoOptions servo) {
  servo.damping.kind = kind;
  scenes::PlainWall wall(n_per_m);
  return run_hold_test(wall, scenes::press_wall(hand, n_per_m, servo));
}

double most_added(const HoldTestResult& run) {
  double most = 0.0;
  for (const ServoTick& tick : run.ticks) most = std::max(most, tick.added_damping_n_s_per_m);
  return most;
}

ServoOptions direct_servo() {
  ServoOptions servo = bare_servo(kTickS);
  servo.velocity_lag_s = VelocityFilter::kUsualLagS;
  return servo;
}

TEST(AdaptiveDamping, SettlesAWallThatCyclesWithFixedDamping) {
  for (const Hand hand : {Hand::push, Hand::light}) {
    const HoldTestResult fixed = held_wall(hand, 8000.0, DampingKind::fixed, direct_servo());
    const HoldTestResult adaptive = held_wall(hand, 8000.0, DampingKind::adaptive, direct_servo());
    EXPECT_EQ(fixed.judgement.verdict, Verdict::limit_cycle) << hand_model(hand).name;
    EXPECT_EQ(adaptive.judgement.verdict, Verdict::quiet) << hand_model(hand).name;
    EXPECT_GT(most_added(adaptive), 5.0);
    EXPECT_LE(most_added(adaptive), 50.0 + 1e-9);
    EXPECT_EQ(most_added(fixed), 0.0);
  }
}

/// Of the tap, which swings for a moment, nothing is left in the hold.
TEST(AdaptiveDamping, AddsNothingInAQuietHold) {
  for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
    const HoldTestResult adaptive = held_wall(hand, 800.0, DampingKind::adaptive, {});
    ASSERT_EQ(adaptive.judgement.verdict, Verdict::quiet);
    double added = 0.0;
    for (std::size_t n = adaptive.ticks.size() - 1000; n < adaptive.ticks.size(); ++n) {
      added = std::max(added, adaptive.ticks[n].added_damping_n_s_per_m);
    }
    EXPECT_LT(added, 0.5) << hand_model(hand).name;
  }
}

TEST(AdaptiveDamping, ReplaysToTheSameBits) {
  HoldTestResult run = held_wall(Hand::push, 8000.0, DampingKind::adaptive, direct_servo());
  ASSERT_GT(most_added(run), 5.0);
  const Recording recording{"", std::move(run.ticks)};
  for (const DampingKind kind : {DampingKind::adaptive, DampingKind::fixed}) {
    FalconModel model;
    model.encoder = Encoder::uniform;
    ReplayDevice device(recording, traits_of(model, kTickS));
    scenes::PlainWall wall(8000.0);
    ServoOptions options = direct_servo();
    options.damping.kind = kind;
    Servo servo(device, wall, options);
    ASSERT_TRUE(replay(servo, recording).ok());
    EXPECT_EQ(device.different() == 0, kind == DampingKind::adaptive);
  }
}

}  // namespace
}  // namespace argil::haptics
