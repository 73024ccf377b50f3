// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/analysis/free_oscillation.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace argil::haptics {
namespace {

struct Peak {
  double time_s;
  double height_mm;
};

/// A peak is the largest sample of a positive lobe, refined by the parabola through five samples:
/// in fewer the steps of an encoder show.
std::vector<Peak> peaks_of(std::span<const double> x, double period_s, double least_mm) {
  std::vector<Peak> peaks;
  std::size_t n = 0;
  while (n < x.size() && x[n] > 0.0) ++n;  // the release itself is no free peak
  while (n < x.size()) {
    while (n < x.size() && x[n] <= 0.0) ++n;
    std::size_t most = n;
    for (; n < x.size() && x[n] > 0.0; ++n) {
      if (x[n] > x[most]) most = n;
    }
    if (n >= x.size() || most < 2 || most + 2 >= x.size() || x[most] < least_mm) continue;
    const double slope = (2.0 * (x[most + 2] - x[most - 2]) + x[most + 1] - x[most - 1]) / 10.0;
    const double bend =
        (2.0 * (x[most + 2] + x[most - 2]) - x[most + 1] - x[most - 1] - 2.0 * x[most]) / 14.0;
    const double middle =
        (x[most - 2] + x[most - 1] + x[most] + x[most + 1] + x[most + 2]) / 5.0 - 2.0 * bend;
    const double shift = bend < 0.0 ? -0.5 * slope / bend : 0.0;
    peaks.push_back({(static_cast<double>(most) + shift) * period_s, middle + 0.5 * slope * shift});
  }
  return peaks;
}

}  // namespace

FreeOscillation estimate_free_oscillation(std::span<const double> position_mm, double period_s,
                                          double stiffness_n_per_m, double delay_s,
                                          double least_peak_mm) {
  assert(period_s > 0.0 && stiffness_n_per_m > 0.0 && delay_s >= 0.0 && least_peak_mm >= 0.0);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  FreeOscillation found;
  const std::vector<Peak> peaks = peaks_of(position_mm, period_s, least_peak_mm);
  found.peaks = static_cast<int>(peaks.size());
  if (peaks.size() < 2) return found;
  const auto turns = static_cast<double>(peaks.size() - 1);
  found.decrement = std::log(peaks.front().height_mm / peaks.back().height_mm) / turns;
  found.damping_ratio_as_printed = found.decrement / kTurn;
  found.damping_ratio =
      found.decrement / std::sqrt(kTurn * kTurn + found.decrement * found.decrement);
  found.omega_rad_per_s = kTurn * turns / (peaks.back().time_s - peaks.front().time_s);
  found.mass_kg_as_printed = stiffness_n_per_m / (found.omega_rad_per_s * found.omega_rad_per_s);
  const double zeta = found.damping_ratio;
  found.mass_kg = found.mass_kg_as_printed * (1.0 - zeta * zeta);
  found.loop_damping_n_s_per_m = 2.0 * zeta * std::sqrt(stiffness_n_per_m * found.mass_kg);
  found.device_damping_n_s_per_m =
      found.loop_damping_n_s_per_m + stiffness_n_per_m * (0.5 * period_s + delay_s);
  return found;
}

}  // namespace argil::haptics
