// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/haptics/force/tool_force.h"

namespace argil::haptics {

/// The contact law of one material with its constants worked out: eq. 2 of Blanch et al. 2004 as a
/// function of the density u, and its integral.
///
/// Threads  Realtime; immutable.
class ContactLaw {
 public:
  explicit ContactLaw(const ForceMaterial& material) noexcept
      : exponent_(material.exponent),
        whole_exponent_(static_cast<int>(std::clamp(material.exponent, 0.0, kMostWhole))),
        is_whole_(material.exponent == whole_exponent_),
        clamp_(material.clamp_ratio),
        clamp_density_(std::pow(material.clamp_ratio, 1.0 / material.exponent)),
        per_skin_(1.0 / material.skin_mm),
        surface_force_(material.surface_force_n),
        potential_scale_(material.surface_force_n * material.skin_mm) {
    assert(material.exponent > 0.0 && material.skin_mm > 0.0 && material.clamp_ratio > 0.0);
    assert(material.surface_force_n >= 0.0);
  }

  /// u of a signed distance: 1 on the surface, 0 from one skin outside.
  double density(double phi_mm) const noexcept { return std::max(0.0, 1.0 - phi_mm * per_skin_); }

  /// min(u^e, kappa): the force as a multiple of f_c0.
  double pressure(double u) const noexcept {
    assert(!(u < 0.0));
    return u >= clamp_density_ ? clamp_ : power(u);
  }

  /// The point force, f_c0 min(u^e, kappa), and how fast it grows with depth.
  double force_n(double u) const noexcept { return surface_force_ * pressure(u); }
  double force_rate_n_per_mm(double u) const noexcept {
    if (u <= 0.0 || u >= clamp_density_) return 0.0;
    return surface_force_ * per_skin_ * exponent_ * power(u) / u;
  }

  /// Phi(u) = f_c0 l integral of `pressure` from 0 to u, in N mm.
  double potential_nmm(double u) const noexcept {
    assert(!(u < 0.0));
    const double below = std::min(u, clamp_density_);
    const double rise = below * power(below) / (exponent_ + 1.0);
    return potential_scale_ * (rise + clamp_ * (u - below));
  }

  double skin_mm() const noexcept { return 1.0 / per_skin_; }

  /// Where the clamp sets in: kappa^(1/e).
  double clamp_density() const noexcept { return clamp_density_; }

 private:
  static constexpr double kMostWhole = 16.0;

  /// u^e; a whole exponent, the usual case, costs a few products instead of std::pow.
  double power(double u) const noexcept {
    if (!is_whole_) return std::pow(u, exponent_);
    double result = 1.0;
    for (int i = 0; i < whole_exponent_; ++i) result *= u;
    return result;
  }

  double exponent_;
  int whole_exponent_;
  bool is_whole_;
  double clamp_;
  double clamp_density_;
  double per_skin_;
  double surface_force_;
  double potential_scale_;
};

}  // namespace argil::haptics
