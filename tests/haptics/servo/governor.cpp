// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/governor.h"

#include <cmath>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

constexpr DeviceTraits kFalcon{0.4589, 3.0, 9.0, 1e-3, 0.06};  // one tick of delay at 1 kHz

/// A real Falcon's 1.5 ms are two ticks of 1 ms.
TEST(DeviceTraits, HaveADelayInWholeTicks) {
  DeviceTraits traits = kFalcon;
  EXPECT_EQ(delay_ticks(traits, 1e-3), 1);
  traits.delay_s = 1.5e-3;
  EXPECT_EQ(delay_ticks(traits, 1e-3), 2);
  EXPECT_EQ(delay_ticks(traits, 4e-3), 0);
  EXPECT_EQ(delay_ticks(traits, 0.25e-3), 6);
}

TEST(Governor, AllowsHalfOfTheFormula) {
  Governor governor({});
  EXPECT_NEAR(governor.tick(1e-3, kFalcon, 1e-3, 0.0), 0.5 * 3.0 / 1.5e-3, 1e-9);
  EXPECT_NEAR(governor.tick(1e-3, kFalcon, 1e-3, 5.0), 0.5 * 8.0 / 1.5e-3, 1e-9);
}

TEST(Governor, FollowsALoopThatSlowsDownWithinATenthOfASecond) {
  Governor governor({});
  double limit = 0.0;
  for (int n = 0; n < 1000; ++n) limit = governor.tick(1e-3, kFalcon, 1e-3, 0.0);
  EXPECT_NEAR(limit, 1000.0, 1.0);
  for (int n = 0; n < 150; ++n) limit = governor.tick(2e-3, kFalcon, 1e-3, 0.0);
  EXPECT_NEAR(limit, 500.0, 30.0);  // after 0.3 s
  // and believes the better rate only slowly
  for (int n = 0; n < 300; ++n) limit = governor.tick(1e-3, kFalcon, 1e-3, 0.0);
  EXPECT_LT(limit, 650.0);
  for (int n = 0; n < 5000; ++n) limit = governor.tick(1e-3, kFalcon, 1e-3, 0.0);
  EXPECT_NEAR(limit, 1000.0, 10.0);
}

TEST(Governor, IsHardlyMovedByOneLateTick) {
  Governor governor({});
  for (int n = 0; n < 100; ++n) governor.tick(1e-3, kFalcon, 1e-3, 0.0);
  EXPECT_GT(governor.tick(5e-3, kFalcon, 1e-3, 0.0), 800.0);
}

/// Clay that is worked late: nothing below 67 ms, then m (pi / tau)^2, and back only slowly.
TEST(Governor, SoftensTheCouplingForLateClay) {
  Governor governor({});
  double limit = 0.0;
  const auto run = [&](int ticks, double lateness_s) {
    for (int n = 0; n < ticks; ++n) limit = governor.tick(1e-3, kFalcon, 1e-3, 0.0, lateness_s);
  };
  run(1000, 0.060);
  EXPECT_NEAR(limit, 1000.0, 1.0);
  run(1000, 0.0905);
  EXPECT_NEAR(limit, chatter_limit_n_per_m(kFalcon.mass_kg, 0.092), 1.0);
  EXPECT_NEAR(limit, 535.0, 5.0);
  run(100, 0.0);
  EXPECT_LT(limit, 700.0);
  run(5000, 0.0);
  EXPECT_NEAR(limit, 1000.0, 1.0);
}

/// A quarter of the limit, on or off, and as late as the filter makes it.
TEST(Governor, BoundsAnAidByRateAndDelay) {
  for (const bool is_on : {true, false}) {
    GovernorOptions options;
    options.is_on = is_on;
    Governor governor(options);
    governor.tick(1e-3, kFalcon, 1e-3, 5.0, 0.2);
    EXPECT_NEAR(governor.aid_stiffness_n_per_m(kFalcon, 1e-3), 0.25 * 3.0 / 1.5e-3, 1e-9);
    DeviceTraits late = kFalcon;
    late.delay_s = 20e-3;
    EXPECT_NEAR(governor.aid_stiffness_n_per_m(late, 1e-3), 0.25 * 3.0 / 20.5e-3, 1e-9);
  }
}

TEST(Governor, LimitsNothingWhenItIsOff) {
  GovernorOptions options;
  options.is_on = false;
  Governor governor(options);
  EXPECT_TRUE(std::isinf(governor.tick(1e-3, kFalcon, 1e-3, 0.0)));
}

}  // namespace
}  // namespace argil::haptics
