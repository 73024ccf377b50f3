// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

/// A handle in the linear regime: mass, damping and hand, pressed into a spring and damper that a
/// servo computes once a tick and holds.
struct LinearLoop {
  /// With the hand's; > 0.
  double mass_kg = 0.4589;
  /// Physical, with the hand's; >= 0.
  double damping_n_s_per_m = 3.0;
  /// Of the hand's spring to its intended position; >= 0.
  double hand_stiffness_n_per_m = 0;
  /// K, rendered.
  double stiffness_n_per_m = 0.0;
  /// c, rendered, from the backward difference of positions.
  double rendered_damping_n_s_per_m = 0.0;
  /// T; > 0.
  double period_s = 1e-3;
  /// Whole ticks from a sample to the hold of its force; 0 to 8.
  int delay_ticks = 1;
};

/// The largest |eigenvalue| of a tick: below 1 the loop is stable.
///
/// Accuracy  exact for the linear loop: matrix exponential of the continuous part; no friction, no
///           quantisation.
/// Threads   any; no allocation.
/// Cost      10 us.
double spectral_radius(const LinearLoop& loop) noexcept;

/// The K at which the loop turns unstable, to 1e-6 relative; `stiffness_n_per_m` of `loop` does not
/// count. 0 when it is unstable at the softest (1 N/m); at most 1e7.
double largest_stable_stiffness_n_per_m(LinearLoop loop) noexcept;

}  // namespace argil::haptics
