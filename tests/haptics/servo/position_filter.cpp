// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/position_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

// Rows (6) to (12) of docs/equations.md. Lengths there are metres, here mm.

/// A filter that has settled at the origin.
PositionFilter at_origin(double gain, double lambda_mm) {
  PositionFilter filter({gain, lambda_mm});
  filter.filter({}, kTickS);
  return filter;
}

/// A jump as any recording may have: from far below to far above lambda.
class Jumps {
 public:
  Vec3 next() {
    const double size = std::pow(10.0, exponent_(random_));
    return size * normalized(Vec3{some_(random_), some_(random_), some_(random_)});
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  std::mt19937_64 random_{11};
  std::uniform_real_distribution<double> exponent_{-3.0, 1.5};
  std::normal_distribution<double> some_{0.0, 1.0};
};

/// One tick with what the equations speak of.
struct Tick {
  Vec3 way;       ///< dp
  Vec3 real;      ///< p_r
  Vec3 damped;    ///< p_d
  Vec3 filtered;  ///< p_f
  double gamma = 0.0;
  double off() const { return length(filtered - real); }
};

Tick filter_tick(PositionFilter& filter, const Vec3& real) {
  const Vec3 way = real - filter.damped_mm();
  const Vec3 filtered = filter.filter(real, kTickS);
  return {way, real, filter.damped_mm(), filtered, filter.confidence()};
}

TEST(Equation6, StepResponseIsTheGeometricSeries) {
  for (const double gain : {0.01, 0.1, 0.5, 1.0}) {
    PositionFilter filter = at_origin(gain, 1.0);
    for (int n = 1; n <= 500; ++n) {
      filter.filter({1.0, 0.0, 0.0}, kTickS);
      ASSERT_NEAR(filter.damped_mm().x, 1.0 - std::pow(1.0 - gain, n), 1e-12) << gain << " " << n;
    }
  }
}

TEST(Equation6, DoesNotDependOnTheRate) {
  for (const double gain : {0.05, 0.1, 0.5}) {
    const double expected = 1.0 - std::pow(1.0 - gain, 20);
    for (const int half_ms : {1, 2, 4, 10}) {
      PositionFilter filter = at_origin(gain, 1.0);
      for (int t = 0; t < 40; t += half_ms) filter.filter({1.0, 0.0, 0.0}, 0.5e-3 * half_ms);
      EXPECT_NEAR(filter.damped_mm().x, expected, 1e-12) << half_ms;
    }
  }
}

TEST(Equation6, ConvertsTheGainAsTheTheorySays) {
  const PositionFilter filter({0.1, 1.0});
  EXPECT_NEAR(filter.gain_over(0.5e-3), 0.0513, 5e-5);
  EXPECT_NEAR(filter.gain_over(1e-3), 0.1, 1e-15);
  EXPECT_NEAR(filter.gain_over(2e-3), 0.19, 1e-15);
  EXPECT_NEAR(filter.gain_over(5e-3), 0.4095, 5e-5);
  EXPECT_EQ(PositionFilter({1.0, 1.0}).gain_over(0.5e-3), 1.0);
}

TEST(Equation7, ConfidenceIsOneHalfAtLambdaAndFallsToZero) {
  const double lambda = 0.3;
  const auto gamma = [&](double way) {
    PositionFilter filter = at_origin(0.2, lambda);
    filter.filter({0.0, way, 0.0}, kTickS);
    return filter.confidence();
  };
  EXPECT_EQ(gamma(0.0), 1.0);
  EXPECT_NEAR(gamma(lambda), 0.5, 1e-15);
  EXPECT_LE(gamma(1e6), 1e-6);
  EXPECT_EQ(gamma(1e300), 0.0);
  double last = 1.0;
  for (int n = 0; n < 170; ++n) {  // from 1 um to 10 m
    const double now = gamma(1e-3 * std::pow(1.1, n));
    ASSERT_LT(now, last);
    ASSERT_GT(now, 0.0);
    last = now;
  }
}

TEST(Equation8and9, FilteredLiesBetweenDampedAndReal) {
  Jumps jumps;
  PositionFilter filter = at_origin(0.15, 0.3);
  Vec3 real;
  for (int n = 0; n < 100000; ++n) {
    real = 0.99 * real + jumps.next();
    const Tick now = filter_tick(filter, real);
    ASSERT_GE(now.gamma, 0.0);
    ASSERT_LE(now.gamma, 1.0);
    const double whole = length(now.damped - now.real);
    const double parts = length(now.damped - now.filtered) + now.off();
    ASSERT_NEAR(parts, whole, 1e-12);
    ASSERT_NEAR(now.off(), now.gamma * whole, 1e-12);  // eq. 9, to 1e-15 m
  }
}

TEST(Equation10, LacksAFactorAsPrinted) {
  for (const double gain : {0.01, 0.1, 0.5, 0.9}) {
    Jumps jumps;
    PositionFilter filter = at_origin(gain, 0.3);
    Vec3 real;
    for (int n = 0; n < 100000; ++n) {
      real = 0.99 * real + jumps.next();
      const Tick now = filter_tick(filter, real);
      const double printed = now.gamma * length(now.way);
      ASSERT_NEAR(now.off(), (1.0 - gain) * printed, 1e-12);
      // The printed one misses by the factor, wherever rounding leaves it to be seen.
      if (printed > 1e-3) {
        ASSERT_NEAR(now.off() / printed, 1.0 - gain, 1e-9);
      }
    }
  }
}

TEST(Equation11and12, NeverLeaveTheBoundAndReachIt) {
  Jumps jumps;
  int violations = 0;
  int above_printed_form = 0;
  double largest_share = 0.0;
  for (int signal = 0; signal < 2000; ++signal) {
    const double gain = std::pow(10.0, jumps.between(-3.0, -0.05));
    const double lambda = std::pow(10.0, jumps.between(-1.5, 0.5));
    const double bound = (1.0 - gain) * lambda;
    PositionFilter filter = at_origin(gain, lambda);
    Vec3 real;
    for (int n = 0; n < 500; ++n) {
      real = 0.98 * real + jumps.next();
      const Tick now = filter_tick(filter, real);
      const double way = length(now.way);
      violations += now.off() > bound ? 1 : 0;
      above_printed_form += now.off() > way / (way / lambda + 1.0) + 1e-12 ? 1 : 0;
      largest_share = std::max(largest_share, now.off() / bound);
    }
  }
  EXPECT_EQ(violations, 0);
  EXPECT_EQ(above_printed_form, 0);
  EXPECT_GT(largest_share, 0.99);
}

TEST(Equation11and12, HoldAtOtherRatesWithTheirOwnGain) {
  Jumps jumps;
  for (const double period : {0.5e-3, 2e-3, 5e-3}) {
    PositionFilter filter = at_origin(0.1, 0.3);
    const double bound = (1.0 - filter.gain_over(period)) * 0.3;
    Vec3 real;
    for (int n = 0; n < 10000; ++n) {
      real = 0.98 * real + jumps.next();
      ASSERT_LE(length(filter.filter(real, period) - real), bound);
    }
  }
}

TEST(PositionFilter, StartsAtTheFirstPosition) {
  PositionFilter filter({});
  const Vec3 start{10.0, -20.0, 30.0};
  EXPECT_LE(length(filter.filter(start, kTickS) - start), 1e-14);
  filter.filter({}, kTickS);
  filter.reset();
  EXPECT_LE(length(filter.filter(start, kTickS) - start), 1e-14);
  EXPECT_EQ(filter.confidence(), 1.0);
}

TEST(PositionFilter, KeepsWhatItHasWhenAPositionIsNotANumber) {
  PositionFilter filter = at_origin(0.2, 0.3);
  const Vec3 before = filter.filter({1.0, 2.0, 3.0}, kTickS);
  const Vec3 damped = filter.damped_mm();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(filter.filter({0.0, nan, 0.0}, kTickS), before);
  EXPECT_EQ(filter.damped_mm(), damped);
  // Time that does not pass does not damp.
  filter.filter({5.0, 5.0, 5.0}, 0.0);
  filter.filter({5.0, 5.0, 5.0}, nan);
  EXPECT_EQ(filter.damped_mm(), damped);
}

/// Behind a handle that moves slowly the damped position stays by the way of that time.
TEST(PositionFilter, LagsASlowMotionByItsLag) {
  for (const double gain : {0.05, 0.2, 0.7, 1.0}) {
    for (const double period_s : {0.25e-3, 1e-3, 4e-3}) {
      const PositionFilterOptions options{gain, 0.3};
      PositionFilter filter(options);
      constexpr double kSpeed = 1.0;  // mm/s
      double way_mm = 0.0;
      for (int n = 0; n < 8000; ++n) filter.filter({way_mm = kSpeed * n * period_s}, period_s);
      EXPECT_NEAR(way_mm - filter.damped_mm().x, kSpeed * filter_lag_s(options, period_s), 1e-9)
          << gain << " " << period_s;
    }
  }
  EXPECT_NEAR(filter_lag_s({0.2, 0.3}, 1e-3), 4e-3, 1e-12);
  EXPECT_NEAR(most_filter_gap_mm({0.2, 0.3}, 1e-3), 0.24, 1e-12);
}

TEST(PositionFilter, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(validate(PositionFilterOptions{}).ok());
  EXPECT_TRUE(validate(PositionFilterOptions{1.0, 1e-3}).ok());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double gain : {0.0, -0.1, 9e-4, 1.01, nan}) {
    const Result<void> result = validate(PositionFilterOptions{gain, 0.3});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
    EXPECT_EQ(result.error().message.substr(0, 8), "gain is ");
  }
  for (const double lambda : {0.0, -1.0, 10.1, std::numeric_limits<double>::infinity(), nan}) {
    const Result<void> result = validate(PositionFilterOptions{0.2, lambda});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message.substr(0, 13), "lambda_mm is ");
  }
}

}  // namespace
}  // namespace argil::haptics
