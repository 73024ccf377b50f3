// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/running_decrement.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A swing about 3 mm, zeta below 0 where it grows, and the frequency of the swing itself.
double decay_mm(double height_mm, double zeta, double hz, double t) {
  const double rate = zeta / std::sqrt(1.0 - zeta * zeta) * kTurn * hz;
  return 3.0 + height_mm * std::exp(-rate * t) * std::cos(kTurn * hz * t);
}

std::string swing_label(double zeta, double hz) {
  return "zeta " + std::to_string(zeta) + ", " + std::to_string(hz) + " Hz";
}

TEST(RunningDecrement, FindsTheDampingRatioOfADecayWithinOnePercent) {
  for (const double zeta : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    for (const double hz : {5.0, 7.3, 11.1, 20.0}) {
      RunningDecrement swing({});
      int found = 0;
      for (double t = 0.0; t < 3.0 / hz; t += kTickS) {
        if (!swing.add(decay_mm(20.0, zeta, hz, t), kTickS)) continue;
        EXPECT_NEAR(swing.damping_ratio(), zeta, 0.01 * zeta) << swing_label(zeta, hz);
        EXPECT_NEAR(swing.omega_rad_per_s(), kTurn * hz, 0.05 * kTurn * hz)
            << swing_label(zeta, hz);
        ++found;
      }
      EXPECT_GE(found, 2) << swing_label(zeta, hz);
    }
  }
}

TEST(RunningDecrement, IsNegativeWhileASwingGrows) {
  RunningDecrement swing({});
  int found = 0;
  for (double t = 0.0; t < 1.0; t += kTickS) {
    if (!swing.add(decay_mm(0.5, -0.05, 12.0, t), kTickS)) continue;
    EXPECT_NEAR(swing.damping_ratio(), -0.05, 0.001);
    EXPECT_LT(swing.decrement(), 0.0);
    ++found;
  }
  EXPECT_GE(found, 15);
}

/// As an encoder gives it: 4 mm in counts of 0.06.
TEST(RunningDecrement, FindsTheDampingRatioOfCountsWithinATenth) {
  for (const double zeta : {0.05, 0.1, 0.2}) {
    RunningDecrement swing({});
    int found = 0;
    for (double t = 0.0; t < 0.25; t += kTickS) {
      const double counted_mm = 0.06 * std::round(decay_mm(4.0, zeta, 10.0, t) / 0.06);
      if (!swing.add(counted_mm, kTickS)) continue;
      EXPECT_NEAR(swing.damping_ratio(), zeta, 0.1 * zeta) << zeta;
      ++found;
    }
    EXPECT_GE(found, 2) << zeta;
  }
}

TEST(RunningDecrement, DoesNotHearWhatIsNoSwing) {
  const auto hears = [](double (*position_mm)(double t)) {
    RunningDecrement swing({});
    bool heard = false;
    for (double t = 0.0; t < 5.0; t += kTickS) heard |= swing.add(position_mm(t), kTickS);
    return heard;
  };
  EXPECT_TRUE(hears([](double t) { return std::cos(kTurn * 10.0 * t); }));
  EXPECT_FALSE(hears([](double t) { return 20.0 * std::cos(kTurn * 3.0 * t); })) << "a hand's own";
  EXPECT_FALSE(hears([](double t) { return 0.06 * std::round(std::fmod(40.0 * t, 1.0)); }))
      << "one count that comes and goes";
  EXPECT_FALSE(hears([](double t) { return 50.0 * t; })) << "no turn";
  EXPECT_FALSE(hears([](double) { return 7.0; })) << "rest";
}

TEST(RunningDecrement, KnowsHowLongAgoTheLastTurnWas) {
  RunningDecrement swing({});
  EXPECT_TRUE(std::isinf(swing.since_turn_s()));
  // One valley at 50 ms and the peak at 100 ms, and then rest.
  for (double t = 0.0; t < 0.3; t += kTickS) {
    swing.add(std::cos(kTurn * 10.0 * std::min(t, 0.125)), kTickS);
  }
  EXPECT_NEAR(swing.since_turn_s(), 0.2, 0.003);
  swing.reset();
  EXPECT_TRUE(std::isinf(swing.since_turn_s()));
}

}  // namespace
}  // namespace argil::haptics
