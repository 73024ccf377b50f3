// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace argil::haptics {

/// What a released handle tells about itself: eq. 3.2 to 3.5 of the Falcon report, and the same
/// without their approximations.
///
/// The damping that a swing shows is the closed loop's: holding a spring's force for a tick, after
/// a delay, feeds K (T / 2 + t_d) of damping back into it. The report takes it for the device's.
struct FreeOscillation {
  int peaks = 0;           ///< that were used; fewer than 2: nothing below means anything
  double decrement = 0.0;  ///< delta of eq. 3.2, the mean over consecutive peaks
  double damping_ratio_as_printed = 0.0;  ///< eq. 3.3: delta / 2 pi, 0.26 % too large at 0.07
  double damping_ratio = 0.0;             ///< delta / sqrt(4 pi^2 + delta^2)
  double omega_rad_per_s = 0.0;           ///< eq. 3.4, of the swing itself: the damped one
  double mass_kg_as_printed = 0.0;        ///< eq. 3.5 with that omega
  double mass_kg = 0.0;                   ///< with the undamped omega
  double loop_damping_n_s_per_m = 0.0;    ///< 2 zeta sqrt(k m): the closed loop's
  double device_damping_n_s_per_m = 0.0;  ///< that plus k (T / 2 + t_d): the device's own
};

/// From positions of consecutive ticks about the rest at 0, from the release on. Peaks lower than
/// `least_peak_mm` are not used.
/// Units     mm, s, N/m; period_s > 0, stiffness > 0.
/// Accuracy  peaks by a parabola through three samples: the ratio of a synthetic decay to 1e-3.
FreeOscillation estimate_free_oscillation(std::span<const double> position_mm, double period_s,
                                          double stiffness_n_per_m, double delay_s,
                                          double least_peak_mm);

}  // namespace argil::haptics
