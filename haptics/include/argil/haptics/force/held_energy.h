// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {

/// A part of a window's energy that is not felt yet, because nobody has paid for it
/// (EnergyAccount).
///
/// Of an energy U the hand feels V^2 / ((V^2 + c^2)^1/2 + c) with V = max(0, U - u): nearly nothing
/// where U is little above u, and all but a constant far above. So a tool that clay was added
/// around is hardly pushed, a hand that presses on is borne, and the force is still minus the
/// gradient of what is felt.
///
/// Units    N mm.
/// Threads  Realtime; pure.
class HeldEnergy {
 public:
  /// Nothing is held back.
  HeldEnergy() noexcept = default;

  /// Held back so that of `energy_nmm` only `felt_nmm` are felt; both >= 0. `most_knee_nmm`: the
  /// most for c, > 0; a force F is borne by a stiffness of at least F^2 / c, which also bounds how
  /// stiff what is held back can make the clay.
  static HeldEnergy of(double energy_nmm, double felt_nmm, double most_knee_nmm) noexcept {
    assert(energy_nmm >= 0.0 && most_knee_nmm > 0.0);
    HeldEnergy held;
    if (felt_nmm >= energy_nmm) return held;
    const double felt = std::max(felt_nmm, 1e-9);
    held.knee_nmm_ = 0.5 * (energy_nmm - felt) * (energy_nmm + felt) / felt;
    if (held.knee_nmm_ <= most_knee_nmm) return held;
    held.knee_nmm_ = most_knee_nmm;
    held.below_nmm_ = energy_nmm - std::sqrt(felt * (felt + 2.0 * most_knee_nmm));
    return held;
  }

  bool is_nothing() const noexcept { return knee_nmm_ <= 0.0; }

  /// What is felt of an energy; >= 0.
  double felt(double energy_nmm) const noexcept {
    if (is_nothing()) return energy_nmm;
    const double above_nmm = std::max(0.0, energy_nmm - below_nmm_);
    return above_nmm * above_nmm / (std::hypot(above_nmm, knee_nmm_) + knee_nmm_);
  }

  /// What is felt of the force where the energy is that: how `felt` grows, 0 to 1.
  double share(double energy_nmm) const noexcept {
    if (is_nothing()) return 1.0;
    const double above_nmm = std::max(0.0, energy_nmm - below_nmm_);
    return above_nmm / std::hypot(above_nmm, knee_nmm_);
  }

 private:
  double knee_nmm_ = 0.0;   ///< c
  double below_nmm_ = 0.0;  ///< u
};

}  // namespace argil::haptics
