// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/analysis/loop_stability.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace argil::haptics {
namespace {

// State of a tick: position, velocity, the position before, the forces not felt yet (oldest first).
constexpr std::size_t kMostDelay = 8;
constexpr std::size_t kMost = 3 + kMostDelay;

struct Matrix {
  std::size_t size = 0;
  std::array<std::array<double, kMost>, kMost> at{};
};

Matrix matrix_product(const Matrix& a, const Matrix& b) noexcept {
  assert(a.size == b.size && a.size <= kMost);
  Matrix c{a.size, {}};
  for (std::size_t i = 0; i < a.size; ++i) {
    for (std::size_t k = 0; k < a.size; ++k) {
      for (std::size_t j = 0; j < a.size; ++j) c.at[i][j] += a.at[i][k] * b.at[k][j];
    }
  }
  return c;
}

double largest_entry(const Matrix& a) noexcept {
  double most = 0.0;
  for (const auto& row : a.at) {
    for (const double value : row) most = std::max(most, std::abs(value));
  }
  return most;
}

/// All entries times `by`.
void scale(Matrix& a, double by) noexcept {
  for (auto& row : a.at) {
    for (double& value : row) value *= by;
  }
}

/// exp(a) by its series on a / 2^k, squared k times.
Matrix exponential(Matrix a) noexcept {
  constexpr int kTerms = 18;
  int halvings = 0;
  while (largest_entry(a) > 0.25) {
    scale(a, 0.5);
    ++halvings;
  }
  Matrix sum{a.size, {}};
  for (std::size_t i = 0; i < a.size; ++i) sum.at[i][i] = 1.0;
  Matrix term = sum;
  for (int n = 1; n <= kTerms; ++n) {
    term = matrix_product(term, a);
    scale(term, 1.0 / n);
    for (std::size_t i = 0; i < a.size; ++i) {
      for (std::size_t j = 0; j < a.size; ++j) sum.at[i][j] += term.at[i][j];
    }
  }
  for (; halvings > 0; --halvings) sum = matrix_product(sum, sum);
  return sum;
}

/// What a tick makes of the state: the continuous part under the oldest force, which is held, and
/// the new force joining the queue.
Matrix tick_of(const LinearLoop& loop) noexcept {
  // Position, velocity and the force held, over one tick.
  Matrix flow{3, {}};
  flow.at[0][1] = loop.period_s;
  flow.at[1][0] = -loop.hand_stiffness_n_per_m / loop.mass_kg * loop.period_s;
  flow.at[1][1] = -loop.damping_n_s_per_m / loop.mass_kg * loop.period_s;
  flow.at[1][2] = loop.period_s / loop.mass_kg;
  const Matrix held = exponential(flow);

  // The force computed now: -K x - c (x - x_before) / T.
  const auto delay = static_cast<std::size_t>(loop.delay_ticks);
  std::array<double, 3> law{};
  law[0] = -loop.stiffness_n_per_m - loop.rendered_damping_n_s_per_m / loop.period_s;
  law[2] = loop.rendered_damping_n_s_per_m / loop.period_s;
  Matrix tick{3 + delay, {}};
  for (std::size_t row = 0; row < 2; ++row) {
    tick.at[row][0] = held.at[row][0];
    tick.at[row][1] = held.at[row][1];
    if (delay > 0) {
      tick.at[row][3] = held.at[row][2];
    } else {
      tick.at[row][0] += held.at[row][2] * law[0];
      tick.at[row][2] += held.at[row][2] * law[2];
    }
  }
  tick.at[2][0] = 1.0;
  for (std::size_t n = 1; n < delay; ++n) tick.at[2 + n][3 + n] = 1.0;
  if (delay > 0) {
    tick.at[2 + delay][0] = law[0];
    tick.at[2 + delay][2] = law[2];
  }
  return tick;
}

}  // namespace

double spectral_radius(const LinearLoop& loop) noexcept {
  assert(loop.mass_kg > 0.0 && loop.period_s > 0.0);
  assert(loop.damping_n_s_per_m >= 0.0 && loop.hand_stiffness_n_per_m >= 0.0);
  assert(loop.delay_ticks >= 0 && static_cast<std::size_t>(loop.delay_ticks) <= kMostDelay);
  // Gelfand: the norm of a high power, by squaring, with the growth kept apart.
  constexpr int kSquarings = 40;
  Matrix power = tick_of(loop);
  double log_growth = 0.0;
  double exponent = 1.0;
  for (int n = 0; n < kSquarings; ++n) {
    const double most = largest_entry(power);
    if (most <= 0.0) return 0.0;
    scale(power, 1.0 / most);
    log_growth += std::log(most) / exponent;
    power = matrix_product(power, power);
    exponent *= 2.0;
  }
  return std::exp(log_growth);
}

double largest_stable_stiffness_n_per_m(LinearLoop loop) noexcept {
  const auto is_unstable = [&](double stiffness) {
    loop.stiffness_n_per_m = stiffness;
    return spectral_radius(loop) >= 1.0;
  };
  double low = 1.0;
  double high = 1e7;
  if (is_unstable(low)) return 0.0;
  while (high / low > 1.0 + 1e-6) {
    const double middle = std::sqrt(low * high);
    (is_unstable(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace argil::haptics
