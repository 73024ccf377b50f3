// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/analysis/loop_chatter.h"

#include <cassert>
#include <cmath>
#include <complex>

namespace argil::haptics {
namespace {

using Complex = std::complex<double>;
constexpr double kTwoPi = 6.28318530717958647692;

/// What e^(-tau s) would have to be at s = i omega for a root there: 1 - D / K, D e^(-t_d s) the
/// force of the spring by the tool's motion. The rest of the loop asks for Q = -(m s^2 + b s + k_h)
/// e^(t_d s) of it, and through a coupling in series for D / (1 + D / k_c) = Q.
Complex delayed_factor(const CarvingLoop& loop, double omega) noexcept {
  const Complex s{0.0, omega};
  const Complex rest =
      loop.mass_kg * s * s + loop.damping_n_s_per_m * s + loop.hand_stiffness_n_per_m;
  const Complex asked = -rest * std::exp(loop.delay_s * s);
  const Complex spring =
      std::isinf(loop.coupling_n_per_m) ? asked : asked / (1.0 - asked / loop.coupling_n_per_m);
  return 1.0 - spring / loop.stiffness_n_per_m;
}

/// The shortest delay, 0 to a turn, that gives this factor of size 1.
double delay_of(const Complex& factor, double omega) noexcept {
  const double angle = std::fmod(kTwoPi - std::arg(factor), kTwoPi);
  return angle / omega;
}

}  // namespace

/// A root on the axis is where the factor has the size 1: looked for from slow to fast in steps of
/// 1/1000, and halved to the last bits.
std::optional<Chatter> first_chatter(const CarvingLoop& loop) noexcept {
  assert(loop.mass_kg > 0.0 && loop.damping_n_s_per_m >= 0.0 && loop.delay_s >= 0.0);
  assert(loop.hand_stiffness_n_per_m >= 0.0 && loop.stiffness_n_per_m > 0.0);
  assert(loop.coupling_n_per_m > 0.0);
  constexpr double kSlowest = 0.5;  // rad/s
  constexpr double kStep = 1.001;
  constexpr int kSteps = 9000;  // to 4000 rad/s
  const auto excess = [&](double omega) { return std::norm(delayed_factor(loop, omega)) - 1.0; };
  std::optional<Chatter> first;
  double next = kSlowest;
  for (int step = 0; step < kSteps; ++step) {
    double low = next;
    double high = next = low * kStep;
    if ((excess(low) > 0.0) == (excess(high) > 0.0)) continue;
    for (int halving = 0; halving < 30; ++halving) {
      const double middle = 0.5 * (low + high);
      ((excess(middle) > 0.0) == (excess(low) > 0.0) ? low : high) = middle;
    }
    // The spring's own delay apart: tau - t_d is what the factor turns by.
    const double late_s = delay_of(delayed_factor(loop, low), low) + loop.delay_s;
    if (!first || late_s < first->lateness_s) first = Chatter{late_s, low / kTwoPi};
  }
  return first;
}

}  // namespace argil::haptics
