// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace argil::haptics {

/// What a released handle tells about itself, by the equations of the Falcon report and by the same
/// without their approximations.
///
/// The damping that a swing shows is the closed loop's: holding a spring's force for a tick T,
/// after a delay t_d, takes K (T / 2 + t_d) from the device's own. The Falcon report takes it
/// for the device's.
///
/// Source  eq. 3.2 to 3.5 of the Falcon report (docs/equations.md); docs/theory.md, "Falcon".
struct FreeOscillation {
  /// Peaks that were used; with fewer than 2 nothing below means anything.
  int peaks = 0;
  /// delta of eq. 3.2, the mean over consecutive peaks.
  double decrement = 0.0;
  /// Eq. 3.3: delta / 2 pi, which is 0.26 % too large at 0.07.
  double damping_ratio_as_printed = 0.0;
  /// zeta: delta / sqrt(4 pi^2 + delta^2).
  double damping_ratio = 0.0;
  /// Eq. 3.4, of the swing itself: the damped frequency.
  double omega_rad_per_s = 0.0;
  /// Eq. 3.5 with that frequency.
  double mass_kg_as_printed = 0.0;
  /// Eq. 3.5 with the undamped frequency.
  double mass_kg = 0.0;
  /// 2 zeta sqrt(k m): the closed loop's.
  double loop_damping_n_s_per_m = 0.0;
  /// That plus k (T / 2 + t_d): the device's own.
  double device_damping_n_s_per_m = 0.0;
};

/// Estimates from positions of consecutive ticks about the rest at 0, from the release on.
///
/// Units     period_s: > 0. stiffness: of the spring, > 0. delay_s: of the loop, >= 0.
///           least_peak_mm: lower peaks are not used.
/// Accuracy  peaks by a parabola through three samples: the ratio of a synthetic decay to 1e-3.
FreeOscillation estimate_free_oscillation(std::span<const double> position_mm, double period_s,
                                          double stiffness_n_per_m, double delay_s,
                                          double least_peak_mm);

}  // namespace argil::haptics
