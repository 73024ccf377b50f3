// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

/// A handle in the linear regime: mass, damping and hand, pressed into a spring and damper that a
/// servo computes once a tick and holds.
struct LinearLoop {
  double mass_kg = 0.4589;                  ///< with the hand's; > 0
  double damping_n_s_per_m = 3.0;           ///< physical, with the hand's; >= 0
  double hand_stiffness_n_per_m = 0;        ///< to the place the hand means; >= 0
  double stiffness_n_per_m = 0.0;           ///< K, rendered
  double rendered_damping_n_s_per_m = 0.0;  ///< c, from the backward difference of positions
  double period_s = 1e-3;                   ///< T; > 0
  int delay_ticks = 1;                      ///< whole ticks from sample to hold; 0 to 8
};

/// The largest |eigenvalue| of a tick: below 1 the loop is stable.
///
/// Exact  matrix exponential of the continuous part, no friction, no quantisation.
/// Cost   about 10 us; allocates nothing.
double spectral_radius(const LinearLoop& loop) noexcept;

/// The K at which the loop turns unstable, to 1e-6 relative; `stiffness_n_per_m` of `loop` does not
/// count. 0 when it is unstable at the softest (1 N/m).
double largest_stable_stiffness_n_per_m(LinearLoop loop) noexcept;

/// The same for c with the loop's own K.
double largest_stable_damping_n_s_per_m(LinearLoop loop) noexcept;

}  // namespace argil::haptics
