// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/guided_hand.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/simulation/sim_falcon.h"

#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

constexpr double kFrameS = 1.0 / 60.0;

/// Intents at 1 kHz under a mouse that goes along x at a speed, from time 0 to `until_s`, and tells
/// its position once a frame.
std::vector<HandIntent> under_mouse(GuidedHand& hand, double speed_mm_per_s, double until_s,
                                    int ticks) {
  std::vector<HandIntent> intents;
  double next_s = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const double now_s = kTickS * n;
    if (now_s >= next_s && next_s <= until_s) {
      HandTarget target;
      target.place_mm.x = speed_mm_per_s * next_s;
      hand.set(target);
      next_s += kFrameS;
    }
    intents.push_back(hand.at(now_s));
  }
  return intents;
}

TEST(GuidedHand, BeginsWhereItIsToldAndHolds) {
  GuidedHand hand({1.0, 2.0, 3.0});
  EXPECT_EQ(hand.start_mm(), (Vec3{1.0, 2.0, 3.0}));
  const HandIntent intent = hand.at(5.0);
  EXPECT_EQ(intent.place_mm, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(intent.velocity_mm_per_s, Vec3{});
  EXPECT_TRUE(intent.holds);
  EXPECT_FALSE(intent.is_active);
}

TEST(GuidedHand, FollowsASteadyMouseAtItsSpeedWithTheLagItStates) {
  GuidedHand hand;
  constexpr double kSpeed = 120.0;
  const std::vector<HandIntent> intents = under_mouse(hand, kSpeed, 1.0, 1000);
  for (std::size_t n = 300; n < intents.size(); ++n) {
    // frames fall between ticks: an interval is seen as 16 or 17 ms
    EXPECT_NEAR(intents[n].velocity_mm_per_s.x, kSpeed, 0.1 * kSpeed) << n;
    const double meant = kSpeed * kTickS * static_cast<double>(n);
    EXPECT_NEAR(intents[n].place_mm.x, meant - 0.0267 * kSpeed, 0.0025 * kSpeed) << n;
  }
}

TEST(GuidedHand, TurnsFramesIntoAMotionWithoutSteps) {
  GuidedHand hand;
  constexpr double kSpeed = 120.0;
  const std::vector<HandIntent> intents = under_mouse(hand, kSpeed, 0.5, 800);
  for (std::size_t n = 1; n < intents.size(); ++n) {
    const Vec3 step = intents[n].place_mm - intents[n - 1].place_mm;
    const Vec3 change = intents[n].velocity_mm_per_s - intents[n - 1].velocity_mm_per_s;
    // A step of the target is 2 mm; of the velocity, unfiltered, 120 mm/s.
    EXPECT_LE(length(step), 1.1 * kSpeed * kTickS) << n;
    EXPECT_LE(length(change), 0.1 * kSpeed) << n;
    const double mean = 0.5 * (intents[n].velocity_mm_per_s.x + intents[n - 1].velocity_mm_per_s.x);
    EXPECT_NEAR(step.x / kTickS, mean, 0.03 * kSpeed) << n;  // the velocity is that of the position
  }
}

TEST(GuidedHand, ComesToRestOnTheTarget) {
  GuidedHand hand;
  HandTarget target;
  target.place_mm = {3.0, -4.0, 5.0};
  hand.set(target);
  HandIntent intent;
  for (int n = 0; n <= 70; ++n) intent = hand.at(kTickS * n);
  EXPECT_LE(length(intent.place_mm - target.place_mm), 2e-3);
  EXPECT_LE(length(intent.velocity_mm_per_s), 0.5);
  for (int n = 71; n <= 300; ++n) intent = hand.at(kTickS * n);
  EXPECT_LE(length(intent.place_mm - target.place_mm), 1e-9);
}

TEST(GuidedHand, TakesAJumpAtAMetreASecond) {
  GuidedHand hand;
  HandTarget target;
  target.place_mm.x = 60.0;
  hand.set(target);
  double fastest = 0.0;
  for (int n = 0; n <= 200; ++n) {
    fastest = std::max(fastest, length(hand.at(kTickS * n).velocity_mm_per_s));
  }
  EXPECT_LE(fastest, 1000.0 + 1e-6);
  EXPECT_NEAR(hand.at(0.5).place_mm.x, 60.0, 1e-6);
}

TEST(GuidedHand, HoldsAndPressesTheButtonAtOnce) {
  GuidedHand hand;
  hand.at(0.0);
  hand.set({{}, true, true});
  EXPECT_TRUE(hand.at(0.001).is_active);
  hand.set({{}, false, false});
  EXPECT_FALSE(hand.at(0.002).is_active);
  EXPECT_FALSE(hand.at(0.003).holds);
}

TEST(GuidedHand, IgnoresWhatIsNoNumber) {
  GuidedHand hand;
  hand.set({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, false, true});
  const HandIntent intent = hand.at(0.1);
  EXPECT_EQ(intent.place_mm, Vec3{});
  EXPECT_TRUE(intent.holds);
  EXPECT_FALSE(intent.is_active);
}

TEST(GuidedHand, BeginsAnewOnAClockThatBeginsAnew) {
  GuidedHand hand;
  under_mouse(hand, 100.0, 0.3, 400);
  hand.set({{9.0, 9.0, 9.0}, false, true});
  hand.begin_at({0.0, 7.0, 0.0});
  const HandIntent intent = hand.at(0.0);
  EXPECT_EQ(intent.place_mm, (Vec3{0.0, 7.0, 0.0}));
  EXPECT_TRUE(intent.holds);
}

TEST(GuidedHand, LeadsASimulatedFalcon) {
  GuidedHand hand({0.0, 5.0, 0.0});
  FalconModel model;
  model.encoder = Encoder::exact;
  SimFalcon device(model, hand_model(Hand::firm), hand);
  EXPECT_EQ(device.true_position_mm(), (Vec3{0.0, 5.0, 0.0}));
  device.read(0.0);
  hand.set({{10.0, 5.0, 0.0}, true, true});
  DeviceReading reading;
  for (int n = 1; n <= 1000; ++n) reading = device.read(kTickS * n);
  EXPECT_NEAR(reading.position_mm.x, 10.0, 0.3);  // friction holds it off by 0.15 N / 0.6 N/mm
  EXPECT_EQ(reading.buttons, 1U);
}

/// Under the thread sanitizer: targets are whole whenever they are read.
TEST(GuidedHandStress, IsLedFromAnotherThread) {
  GuidedHand hand;
  std::atomic<bool> stop = false;
  std::thread mouse([&] {
    for (int n = 0; !stop.load(); ++n) {
      const double place = n % 40;
      hand.set({{place, place, place}, true, n % 2 == 0});
    }
  });
  for (int n = 0; n < 20'000; ++n) {
    const HandIntent intent = hand.at(1e-4 * n);
    ASSERT_EQ(intent.place_mm.x, intent.place_mm.y);
    ASSERT_EQ(intent.place_mm.x, intent.place_mm.z);
  }
  stop = true;
  mouse.join();
}

}  // namespace
}  // namespace argil::haptics
