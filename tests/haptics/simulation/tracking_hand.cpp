// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/tracking_hand.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

constexpr double kTickS = 1e-3;

std::vector<HandKey> resting() { return {HandKey{}}; }

TrackingHandOptions steady() {
  TrackingHandOptions options;
  options.stray_mm = 0.0;
  return options;
}

/// A tick in which the tool is so far from where the hand means it to be.
ServoTick tick_at(TrackingHand& hand, double time_s, const Vec3& off_mm) {
  ServoTick tick;
  tick.time_s = time_s;
  tick.is_ready = true;
  tick.position_mm = tick.proxy_mm = hand.at(time_s).place_mm + off_mm;
  return tick;
}

/// How far from the plan the tool is in the end, something having held it off all the time.
double error_after(const TrackingHandOptions& options, double seconds) {
  TrackingHand hand(resting(), options);
  ServoTick tick;
  for (int n = 0; n < static_cast<int>(seconds / kTickS); ++n) {
    tick = tick_at(hand, kTickS * n, {5.0, 0.0, 0.0});
    hand.see(tick);
  }
  return tick.proxy_mm.x;
}

TEST(TrackingHand, CorrectsWhatItSeesAndNothingBlindfolded) {
  EXPECT_LT(std::abs(error_after(steady(), 5.0)), 0.1);
  TrackingHandOptions blind = steady();
  blind.is_sighted = false;
  EXPECT_EQ(error_after(blind, 5.0), 5.0);
}

TEST(TrackingHand, AnswersAfterItsReactionTimeAndNotBefore) {
  EXPECT_EQ(error_after(steady(), 0.19), 5.0);
  // A tenth of a second at 2 / s: 5 exp(-0.2).
  EXPECT_NEAR(error_after(steady(), 0.3), 4.0, 0.15);
}

/// A press meets a surface: how deep it lies is felt and not seen.
TEST(TrackingHand, DoesNotPressHarderBecauseTheSurfaceHoldsItOff) {
  std::vector<HandKey> pressing = resting();
  pressing[0].press_n = 2.0;
  TrackingHand hand(pressing, steady());
  for (int n = 0; n < 3000; ++n) hand.see(tick_at(hand, kTickS * n, {0.0, 3.0, 0.0}));
  EXPECT_EQ(hand.at(3.0).place_mm, Vec3{});
}

TEST(TrackingHand, StraysAsFarAsItIsToldAndAlikeForTheSameSeed) {
  TrackingHandOptions options;
  options.stray_mm = 2.0;
  TrackingHand one(resting(), options);
  TrackingHand again(resting(), options);
  options.seed = 2;
  TrackingHand other(resting(), options);
  double square = 0.0;
  double apart = 0.0;
  double fastest = 0.0;
  constexpr int kTicks = 200'000;
  Vec3 before = one.at(0.0).place_mm;
  EXPECT_EQ(before, Vec3{}) << "it begins where it means to";
  for (int n = 0; n < kTicks; ++n) {
    const Vec3 at = one.at(kTickS * n).place_mm;
    ASSERT_EQ(at, again.at(kTickS * n).place_mm);
    square += dot(at, at) / kTicks;
    apart = std::max(apart, length(at - other.at(kTickS * n).place_mm));
    fastest = std::max(fastest, length(at - before) / kTickS);
    before = at;
  }
  EXPECT_NEAR(std::sqrt(square / 3.0), 2.0, 0.2);
  EXPECT_GT(apart, 2.0);
  EXPECT_LT(fastest, 60.0) << "mm/s: no hand jumps";
}

TEST(TrackingHand, PressesItsButtonAfterASuddenForceOnly) {
  TrackingHandOptions options = steady();
  options.is_sighted = false;
  options.notices_n = 0.4;
  TrackingHand hand(resting(), options);
  const auto feel = [&](int n, double force_n) {
    ServoTick tick = tick_at(hand, kTickS * n, {});
    tick.force_n = {force_n, 0.0, 0.0};
    hand.see(tick);
  };
  for (int n = 0; n < 4000; ++n) feel(n, 1.0 + 0.5e-3 * n);  // 0.5 N in a second: a slope
  EXPECT_FALSE(hand.at(4.5).is_active);
  for (int n = 4000; n < 4100; ++n) feel(n, 4.0);
  EXPECT_FALSE(hand.at(4.15).is_active) << "not before it could";
  EXPECT_TRUE(hand.at(4.25).is_active);
}

}  // namespace
}  // namespace argil::haptics
