// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/device.h"

namespace argil::haptics {

/// The stiffness that a sampled loop can render with a released handle: (b + c) / (T / 2 + t_d), b
/// the device's damping, c that of the contact, T the tick, t_d the delay (theory A, "Stability
/// with delay"; LoopStability.* holds it to the exact eigenvalue).
/// Units  N s/m and s; `period_s` > 0. Result in N/m.
double stiffness_limit_n_per_m(double damping_n_s_per_m, double period_s, double delay_s) noexcept;

struct GovernorOptions {
  bool is_on = true;
  double share = 0.5;      ///< of the limit that is used; 0 to 1, more is stiffer and nearer
                           ///< to buzzing
  double settle_s = 0.1;   ///< how fast a slower loop is believed; > 0
  double recover_s = 1.0;  ///< how slowly a faster one; >= settle_s
};

/// Keeps the rendered stiffness inside the stable region by what the loop really does: watches the
/// period, and gives the stiffness that the coupling may have.
///
/// Threads  Realtime.
class Governor {
 public:
  explicit Governor(const GovernorOptions& options) noexcept : options_(options) {}

  /// One tick that took `period_s` since the last one, on a device with these traits (of the
  /// nominal period: a delay in ticks grows with the period). Damping of the coupling in N s/m.
  /// Result in N/m; infinite when switched off.
  double tick(double period_s, const DeviceTraits& traits, double nominal_period_s,
              double coupling_damping_n_s_per_m) noexcept;

  double period_s() const noexcept { return period_s_; }  ///< as it is believed now; 0 before

 private:
  GovernorOptions options_;
  double period_s_ = 0.0;
};

}  // namespace argil::haptics
