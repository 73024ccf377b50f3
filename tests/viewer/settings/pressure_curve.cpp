// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/pressure_curve.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "settings/settings.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

TEST(PressureCurves, PassThroughTheirPointsAndNeverFall) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.2, 1.2);
  for (int n = 0; n < 300; ++n) {
    const PressureCurve curve =
        in_range({any(random), {{{any(random), any(random)}, {any(random), any(random)}}}});
    EXPECT_EQ(in_range(curve), curve);
    EXPECT_NEAR(shaped_pressure(curve, 0.0), curve.start, 1e-12);
    EXPECT_EQ(shaped_pressure(curve, 1.0), 1.0) << "a mouse stays what it is";
    for (const PressureCurve::Point& point : curve.points) {
      EXPECT_NEAR(shaped_pressure(curve, point.x), point.y, 1e-12);
    }
    double last = 0.0;
    for (double p = 0.0; p <= 1.0; p += 0.004) {
      const double now = shaped_pressure(curve, p);
      EXPECT_GE(now, last - 1e-12) << p;
      EXPECT_LE(now, 1.0);
      last = now;
    }
  }
}

TEST(PressureCurves, OfTheLinearOneAreThePressureItself) {
  for (double p = 0.0; p <= 1.0; p += 0.013) EXPECT_EQ(shaped_pressure(kLinearPressure, p), p);
  EXPECT_GT(shaped_pressure(kSoftPressure, 0.3), 0.55);
  EXPECT_LT(shaped_pressure(kFirmPressure, 0.5), 0.2);
}

TEST(PressureCurves, AreReadAsTheyWereWritten) {
  for (const PressureCurve& curve : {kSoftPressure, kFirmPressure, kLinearPressure,
                                     PressureCurve{0.125, {{{0.25, 0.5}, {0.75, 0.5}}}}}) {
    const auto read = pressure_of(text_of(curve));
    ASSERT_TRUE(read) << text_of(curve);
    for (double p = 0.0; p <= 1.0; p += 0.1) {
      EXPECT_NEAR(shaped_pressure(*read, p), shaped_pressure(curve, p), 1e-5);
    }
  }
  for (const char* const wrong :
       {"", "1", "0 .3 .3 .7", "0 .3 .3 .7 .7 1", "0 .7 .3 .3 .7", "2 .3 .3 .7 .7", "0 .3 .8 .7 .2",
        "nan .3 .3 .7 .7", "0 x .3 .7 .7"}) {
    EXPECT_FALSE(pressure_of(wrong)) << wrong;
  }
}

TEST(PressureCurves, AreKeptAmongTheSettings) {
  const test::ScratchFolder home;
  Settings before = read_settings(home.path());
  EXPECT_EQ(before.pressure, PressureCurve());
  Settings after = before;
  after.pressure = kFirmPressure;
  ASSERT_TRUE(write_changes(home.path(), before, after).ok());
  EXPECT_EQ(read_settings(home.path()).pressure, kFirmPressure);
  // Another window that changes something else leaves it.
  Settings other = before;
  other.printer = "resin";
  ASSERT_TRUE(write_changes(home.path(), before, other).ok());
  EXPECT_EQ(read_settings(home.path()).pressure, kFirmPressure);
}

}  // namespace
}  // namespace argil::viewer
