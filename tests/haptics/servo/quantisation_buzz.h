// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

/// Force from peak to peak that one count of the encoder makes as it comes and goes:
/// 2 c quantum / T * T / (T + lag) + K quantum, `lag_s` being that of a VelocityFilter.
inline double quantisation_buzz_n(double damping_n_s_per_m, double stiffness_n_per_m,
                                  double quantum_mm, double period_s, double lag_s = 0.0) {
  const double quantum_m = 1e-3 * quantum_mm;
  const double damping = damping_n_s_per_m * (period_s / (period_s + lag_s));
  return 2.0 * damping * quantum_m / period_s + stiffness_n_per_m * quantum_m;
}

}  // namespace argil::haptics
