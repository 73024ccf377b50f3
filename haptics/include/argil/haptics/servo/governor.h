// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "argil/haptics/servo/device.h"

namespace argil::haptics {

/// The stiffness that a sampled loop can render with a released handle: (b + c) / (T / 2 + t_d), b
/// the device's damping, c that of the contact, T the tick, t_d the delay.
///
/// Units     damping: b + c. period_s: T, > 0. delay_s: t_d, >= 0. Result in N/m.
/// Accuracy  2 % of the exact eigenvalue for a Falcon, 0.25 to 2 ms
///           (LoopStability.AgreesWithTheFormulaForAReleasedHandle).
/// Threads   Realtime; pure.
/// Source    docs/theory.md, "Stiffness".
double stiffness_limit_n_per_m(double damping_n_s_per_m, double period_s, double delay_s) noexcept;

/// The stiffest spring behind which a handle of this mass does not chatter on clay that gives way
/// later than the tool works it, however hard the clay: m (pi / tau)^2. Carving is a spring that
/// acts late, F = K (x(t) - x(t - tau)); such a loop cycles never before tau = pi (m / 2 K)^1/2,
/// and behind a coupling k_c less than k_c stands for 2 K. Sufficient and not sharp: hands add mass
/// and damping.
///
/// Units     mass_kg: > 0. lateness_s: tau, from the tool's motion to the force that knows of it, >
/// 0.
///           Result in N/m.
/// Threads   Realtime; pure.
/// Source    S. A. Tobias, W. Fishwick, "The chatter of lathe tools under orthogonal cutting
///           conditions", Trans. ASME 80 (1958); docs/theory.md, "Late windows".
double chatter_limit_n_per_m(double mass_kg, double lateness_s) noexcept;

struct GovernorOptions {
  bool is_on = true;
  /// Fraction of the limit that is used; usual 0.5, > 0, at most 1. More is stiffer and nearer to
  /// buzzing.
  double share = 0.5;
  /// Time constant with which a slower loop is believed; usual 0.1, > 0.
  double settle_s = 0.1;
  /// The same for a faster loop; usual 1, >= settle_s.
  double recover_s = 1.0;
};

/// Keeps the rendered stiffness inside the stable region by what the loop really does: measures the
/// period, hears how late the clay is that the tool works, and says how stiff the coupling may be.
/// A Falcon's 1 000 N/m at 1 kHz are within the second limit up to 67 ms.
///
/// Threads  Realtime.
class Governor {
 public:
  explicit Governor(const GovernorOptions& options) noexcept : options_(options) {
    assert(options.share > 0.0 && options.settle_s > 0.0 && options.recover_s > 0.0);
  }

  /// The most stiffness of the coupling, N/m, after a tick that began `period_s` after the last
  /// one; infinite when switched off.
  ///
  /// Units  traits: of a loop at `nominal_period_s` (> 0); its delay is taken to grow with the
  ///        period. period_s: one that is not greater than 0 teaches nothing. lateness_s: of what
  ///        the tool works (WindowStamp), >= 0; believed as the period is.
  double tick(double period_s, const DeviceTraits& traits, double nominal_period_s,
              double coupling_damping_n_s_per_m, double lateness_s = 0.0) noexcept;

  /// How stiff a force beside the coupling may be, such as guidance, by the period of the last
  /// tick: half of what the coupling may be by rate and delay alone, so that both together stay
  /// within the limit; without the contact's damping, which it may act without. Also when the
  /// governor is off: what is switched off is the bound of what is touched.
  double aid_stiffness_n_per_m(const DeviceTraits& traits, double nominal_period_s) const noexcept;

  /// The period as it is believed now; 0 before the first tick.
  double period_s() const noexcept { return period_s_; }

 private:
  double delay_s(const DeviceTraits& traits, double nominal_period_s) const noexcept {
    return traits.delay_s * period_s_ / nominal_period_s;
  }
  double believe(double value, double before, double period_s) const noexcept;

  GovernorOptions options_;
  double period_s_ = 0.0;
  double lateness_s_ = 0.0;
};

}  // namespace argil::haptics
