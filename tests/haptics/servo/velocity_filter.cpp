// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/velocity_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/servo/quantisation_buzz.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

// docs/theory.md, "Damping", and row (1) of docs/equations.md.

constexpr double kMassKg = 0.4589;

TEST(VelocityFilter, IsTheDifferenceWithoutALag) {
  VelocityFilter filter(0.0);
  EXPECT_EQ(filter.velocity({1.0, 2.0, 3.0}, kTickS), Vec3{});
  const Vec3 v = filter.velocity({1.5, 2.0, 2.0}, 2e-3);
  EXPECT_LE(length(v - Vec3{250.0, 0.0, -500.0}), 1e-9);
}

TEST(VelocityFilter, IsLateByItsLagAndHalfAPeriod) {
  const double acceleration = 3000.0;
  for (const double lag : {0.0, 3e-3, 10e-3}) {
    for (const double period : {0.5e-3, 1e-3, 5e-3}) {
      VelocityFilter filter(lag);
      double t = 0.0;
      double v = 0.0;
      for (int n = 0; n < 1000; ++n) {
        t = n * period;
        v = filter.velocity({0.0, 0.5 * acceleration * t * t, 0.0}, period).y;
      }
      const double late = t - v / acceleration;
      EXPECT_NEAR(late, lag + 0.5 * period, 1e-9) << lag << " " << period;
    }
  }
}

TEST(VelocityFilter, IsExactOnSteadyMotionAtUnevenTimes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> period(0.2e-3, 4e-3);
  const Vec3 velocity{30.0, -20.0, 10.0};
  VelocityFilter filter;
  Vec3 place;
  filter.velocity(place, kTickS);
  Vec3 result;
  for (int n = 0; n < 1000; ++n) {
    const double dt = period(random);
    place += dt * velocity;
    result = filter.velocity(place, dt);
  }
  EXPECT_LE(length(result - velocity), 1e-9);
}

TEST(VelocityFilter, OutlivesStandingTimeAndWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  VelocityFilter filter(0.0);
  filter.velocity({}, kTickS);
  const Vec3 before = filter.velocity({1.0, 0.0, 0.0}, kTickS);
  for (const double period : {0.0, -1.0, nan, infinite, 1e-9}) {
    EXPECT_EQ(filter.velocity({1.4, 0.0, 0.0}, period), before);
  }
  EXPECT_EQ(filter.velocity({nan, 0.0, 0.0}, kTickS), before);
  // 1 mm further, 2 ms after the last position that counted.
  EXPECT_NEAR(filter.velocity({2.0, 0.0, 0.0}, kTickS).x, 500.0, 1e-3);
}

TEST(VelocityFilter, ForgetsAtReset) {
  VelocityFilter filter;
  filter.velocity({}, kTickS);
  filter.velocity({1.0, 1.0, 1.0}, kTickS);
  filter.reset();
  EXPECT_EQ(filter.velocity({50.0, 0.0, 0.0}, kTickS), Vec3{});
  EXPECT_LE(length(filter.velocity({50.0, 0.0, 0.0}, kTickS)), 1e-12);
}

/// Force from peak to peak on a handle whose position comes and goes by one quantum every tick.
double buzz_of_a_count(double damping, double stiffness, double quantum_mm, double lag_s) {
  VelocityFilter filter(lag_s);
  double least = 1e9;
  double most = -1e9;
  for (int n = 0; n < 2000; ++n) {
    const double x = n % 2 == 0 ? 0.0 : quantum_mm;
    const double v = filter.velocity({x, 0.0, 0.0}, kTickS).x;
    if (n < 1000) continue;
    const double force = 1e-3 * (stiffness * x + damping * v);
    least = std::min(least, force);
    most = std::max(most, force);
  }
  return most - least;
}

TEST(QuantisationBuzz, IsThatOfOneCountThatComesAndGoes) {
  EXPECT_NEAR(quantisation_buzz_n(50.0, 3000.0, 0.06, kTickS), 6.18, 1e-12);
  EXPECT_NEAR(quantisation_buzz_n(20.0, 3000.0, 0.06, kTickS), 2.6, 0.05);
  EXPECT_NEAR(quantisation_buzz_n(10.0, 3000.0, 0.06, kTickS), 1.4, 0.05);
  EXPECT_LE(quantisation_buzz_n(2.66, 3000.0, 0.06, kTickS), 0.5);
  for (const double c : {0.0, 10.0, 50.0}) {
    EXPECT_NEAR(buzz_of_a_count(c, 3000.0, 0.06, 0.0), quantisation_buzz_n(c, 3000.0, 0.06, kTickS),
                1e-9);
  }
}

TEST(QuantisationBuzz, IsBoundedByTheShareOfTheNewestPosition) {
  for (const double lag : {1e-3, 3e-3, 9e-3}) {
    const double bound = quantisation_buzz_n(50.0, 3000.0, 0.06, kTickS, lag);
    EXPECT_NEAR(bound, 6.0 * kTickS / (kTickS + lag) + 0.18, 1e-12);
    EXPECT_LE(buzz_of_a_count(50.0, 3000.0, 0.06, lag), bound);
  }
  // What the usual lag was chosen for.
  EXPECT_LE(quantisation_buzz_n(10.0, 3000.0, 0.06, kTickS, VelocityFilter::kUsualLagS), 0.5);
  EXPECT_GT(quantisation_buzz_n(10.0, 3000.0, 0.06, kTickS, 2.5e-3), 0.5);
}

using Complex = std::complex<double>;

/// Largest |z| of the roots of z^n + ... , coefficients from the constant up, leading one left out
/// (Durand and Kerner: all roots at once).
double largest_root(const std::vector<double>& coefficients) {
  const std::size_t n = coefficients.size();
  std::vector<Complex> roots(n);
  for (std::size_t i = 0; i < n; ++i) roots[i] = std::pow(Complex(0.4, 0.9), i);
  for (int round = 0; round < 500; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      Complex value = 1.0;
      for (std::size_t k = n; k-- > 0;) value = value * roots[i] + coefficients[k];
      for (std::size_t j = 0; j < n; ++j) {
        if (j != i) value /= roots[i] - roots[j];
      }
      roots[i] -= value;
    }
  }
  double largest = 0.0;
  for (const Complex& z : roots) largest = std::max(largest, std::abs(z));
  return largest;
}

/// The closed loop of a damped free mass without stiffness, as the difference w of its position
/// from tick to tick: w(n+1) = w(n) + T^2 / (2 m) (f(n) + f(n-1)), f(n) = -B / T of the mean of
/// w(n-d), whose newest value has the share `share`.
double largest_eigenvalue(double damping, double period, int delay, double share = 1.0) {
  // (z - 1) (z - (1 - share)) z^d + share g / 2 (z + 1) = 0, g = B T / m.
  const double half = 0.5 * share * damping * period / kMassKg;
  const auto d = static_cast<std::size_t>(delay);
  std::vector<double> polynomial(d + 2, 0.0);
  polynomial[0] += half;
  polynomial[1] += half;
  polynomial[d] += 1.0 - share;
  polynomial[d + 1] -= 2.0 - share;
  return largest_root(polynomial);
}

/// g = B T / m where the largest root leaves the unit circle.
double largest_stable_g(int delay, double share = 1.0) {
  double stable = 0.01;
  double unstable = 4.0;
  for (int n = 0; n < 60; ++n) {
    const double g = 0.5 * (stable + unstable);
    const double damping = g * kMassKg / kTickS;
    (largest_eigenvalue(damping, kTickS, delay, share) > 1.0 ? unstable : stable) = g;
  }
  return stable;
}

/// Largest damping that is stable on a free mass, from raw differences of the position, when the
/// force is held for a tick T and comes d = `delay_ticks` ticks late: g m / T with g = 2 tan(pi /
/// (4 (1 + d))), which is 2, 0.83 and 0.54 for 0, 1 and 2 ticks. With a filter's lag it is a little
/// less: 0.70 for 1 tick and VelocityFilter::kUsualLagS at 1 kHz.
///
/// Units    mass_kg, period_s: > 0. delay_ticks: >= 0. Result in N s/m.
/// Source   own: (z - 1) z^(d+1) + B T / (2 m) (z + 1) = 0 with z on the unit circle.
double most_damping_n_s_per_m(double mass_kg, double period_s, int delay_ticks) {
  const double g = 2.0 * std::tan(std::numbers::pi / (4.0 * (1.0 + delay_ticks)));
  return g * mass_kg / period_s;
}

TEST(MostDamping, IsWhereTheClosedLoopLeavesTheUnitCircle) {
  for (int delay = 0; delay <= 6; ++delay) {
    const double g = most_damping_n_s_per_m(kMassKg, kTickS, delay) * kTickS / kMassKg;
    EXPECT_NEAR(largest_stable_g(delay), g, 1e-6) << delay;
  }
}

TEST(MostDamping, HasTheFiguresOfTheTheory) {
  EXPECT_NEAR(most_damping_n_s_per_m(1.0, 1.0, 0), 2.0, 1e-12);
  EXPECT_NEAR(most_damping_n_s_per_m(1.0, 1.0, 1), 2.0 * (std::sqrt(2.0) - 1.0), 1e-12);
  EXPECT_NEAR(most_damping_n_s_per_m(1.0, 1.0, 2), 0.54, 0.005);
  EXPECT_NEAR(most_damping_n_s_per_m(kMassKg, kTickS, 0), 921.0, 4.0);
  EXPECT_NEAR(most_damping_n_s_per_m(kMassKg, kTickS, 1), 381.0, 1.0);
  EXPECT_NEAR(most_damping_n_s_per_m(kMassKg, kTickS, 2), 246.0, 0.5);
  // c = 50 at one tick: until T is above 7.6 ms, or the mass below 60 g.
  EXPECT_NEAR(most_damping_n_s_per_m(kMassKg, 7.6e-3, 1), 50.0, 0.1);
  EXPECT_NEAR(most_damping_n_s_per_m(0.060, kTickS, 1), 50.0, 0.5);
}

TEST(MostDamping, IsLittleLessWithTheUsualLag) {
  const double share = kTickS / (kTickS + VelocityFilter::kUsualLagS);
  EXPECT_NEAR(largest_stable_g(1, share), 0.705, 0.001);
}

/// |w| of the free mass after a second, by stepping the very filter: a push, then damping alone.
double speed_after_a_second(double damping) {
  VelocityFilter filter(0.0);
  double x_mm = 0.0;
  double v_mm_per_s = 1.0;
  double late_n = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force_n = -1e-3 * damping * filter.velocity({x_mm, 0.0, 0.0}, kTickS).x;
    const double acceleration = 1e3 * late_n / kMassKg;  // written one tick ago
    late_n = force_n;
    x_mm += kTickS * (v_mm_per_s + 0.5 * kTickS * acceleration);
    v_mm_per_s += kTickS * acceleration;
  }
  return std::abs(v_mm_per_s);
}

TEST(Equation1, DampingOf300IsStableAnd450IsNot) {
  EXPECT_LT(largest_eigenvalue(300.0, kTickS, 1), 1.0);
  EXPECT_GT(largest_eigenvalue(450.0, kTickS, 1), 1.0);
  EXPECT_LT(speed_after_a_second(300.0), 1e-6);
  EXPECT_GT(speed_after_a_second(450.0), 1e3);
}

}  // namespace
}  // namespace argil::haptics
