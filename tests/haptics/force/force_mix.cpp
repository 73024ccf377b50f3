// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/force_mix.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

// Rows (3) to (5) of docs/equations.md.

constexpr double kMixTickS = 1e-3;
constexpr Vec3 kContact{0.3, -1.7, 2.9};
constexpr Vec3 kViscosity{-0.9, 0.4, -0.2};
constexpr ForceMix kMix{0.97, 0.31, 0.23, 1.13};

TEST(Equation3to5, EndsAreTheTwoModes) {
  const Vec3 passive = kMix.contact_passive * kContact + kMix.viscosity_passive * kViscosity;
  const Vec3 active = kMix.contact_active * kContact + kMix.viscosity_active * kViscosity;
  EXPECT_LE(length(mix_forces(kMix, kContact, kViscosity, 0.0) - passive), 1e-15);
  EXPECT_LE(length(mix_forces(kMix, kContact, kViscosity, 1.0) - active), 1e-15);
  const Vec3 middle = mix_forces(kMix, kContact, kViscosity, 0.5);
  EXPECT_LE(length(middle - 0.5 * (passive + active)), 1e-15);
}

TEST(Equation3to5, IsThePrintedSumInBetween) {
  for (int percent = 0; percent <= 100; ++percent) {
    const double p = 0.01 * percent;
    const ForceMix& m = kMix;
    const Vec3 printed =
        (m.contact_passive + p * (m.contact_active - m.contact_passive)) * kContact +
        (m.viscosity_passive + p * (m.viscosity_active - m.viscosity_passive)) * kViscosity;
    EXPECT_LE(length(mix_forces(m, kContact, kViscosity, p) - printed), 2e-15);
  }
}

TEST(Equation3to5, RampsInATenthOfASecondBothWays) {
  ModeBlend blend;
  const Vec3 passive = mix_forces(kMix, kContact, kViscosity, 0.0);
  const double whole = length(mix_forces(kMix, kContact, kViscosity, 1.0) - passive);
  Vec3 last = passive;
  double largest_step = 0.0;
  const auto step = [&](bool is_active) {
    const Vec3 force = mix_forces(kMix, kContact, kViscosity, blend.tick(is_active, kMixTickS));
    largest_step = std::max(largest_step, length(force - last));
    last = force;
  };
  for (int n = 0; n < 50; ++n) step(true);
  EXPECT_NEAR(blend.p(), 0.5, 1e-12);
  for (int n = 0; n < 60; ++n) step(true);
  EXPECT_EQ(blend.p(), 1.0);
  for (int n = 0; n < 30; ++n) step(false);
  EXPECT_NEAR(blend.p(), 0.7, 1e-12);
  for (int n = 0; n < 10; ++n) step(true);  // turns back from where it is
  EXPECT_NEAR(blend.p(), 0.8, 1e-12);
  for (int n = 0; n < 90; ++n) step(false);
  EXPECT_EQ(blend.p(), 0.0);
  EXPECT_LE(largest_step, 0.011 * whole);
  EXPECT_GE(largest_step, 0.009 * whole);
}

TEST(Equation3to5, RampTakesTheSameTimeAtAnyRate) {
  for (const double period : {0.5e-3, 2e-3, 5e-3}) {
    ModeBlend blend;
    double time = 0.0;
    while (blend.tick(true, period) < 1.0 - 1e-9) time += period;
    EXPECT_NEAR(time + period, ModeBlend::kUsualRampS, 1e-9) << period;
  }
}

TEST(Equation3to5, RampCanBeAnotherOrNone) {
  ModeBlend slow(0.4);
  EXPECT_NEAR(slow.tick(true, 0.1), 0.25, 1e-15);
  EXPECT_NEAR(slow.tick(true, 0.0), 0.25, 1e-15);
  EXPECT_NEAR(slow.tick(true, std::numeric_limits<double>::quiet_NaN()), 0.25, 1e-15);
  ModeBlend none(0.0);
  EXPECT_EQ(none.tick(true, kMixTickS), 1.0);
  EXPECT_EQ(none.tick(false, kMixTickS), 0.0);
}

void expect_refused(const ForceMix& mix, const std::string& message) {
  const Result<void> result = validate(mix);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(result.error().message, message);
}

TEST(Equation3to5, InequalitiesAreEnforced) {
  EXPECT_TRUE(validate(ForceMix{}).ok());
  EXPECT_TRUE(validate(kMix).ok());
  expect_refused({0.4, 0.5, 0.3, 1.0},
                 "contact_passive is 0.4 and viscosity_passive is 0.5; contact_passive must be "
                 "greater than viscosity_passive");
  expect_refused({1.0, 0.2, 0.6, 0.6},
                 "viscosity_active is 0.6 and contact_active is 0.6; viscosity_active must be "
                 "greater than contact_active");
  expect_refused({0.5, 0.3, 0.8, 1.0},
                 "contact_passive is 0.5 and contact_active is 0.8; contact_passive must be "
                 "greater than contact_active");
  expect_refused({1.0, 0.7, 0.2, 0.4},
                 "viscosity_active is 0.4 and viscosity_passive is 0.7; viscosity_active must be "
                 "greater than viscosity_passive");
  expect_refused({1.0, 0.3, -0.1, 1.0}, "contact_active is -0.1; must be 0.01 to 2");
  expect_refused({1.0, -0.1, 0.3, 1.0}, "viscosity_passive is -0.1; must be 0 to 2");
  ForceMix endless;
  endless.contact_passive = std::numeric_limits<double>::infinity();
  expect_refused(endless, "contact_passive is inf; must be 0.01 to 2");
  endless.contact_passive = std::numeric_limits<double>::quiet_NaN();
  expect_refused(endless, "contact_passive is nan; must be 0.01 to 2");
}

}  // namespace
}  // namespace argil::haptics
