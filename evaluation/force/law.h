// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/haptics/force/tool_force.h"

namespace argil::evaluation {

/// The laws of docs/forces.md for a whole exponent, derived a second time on purpose: what judges
/// the sums of haptics must share no code with them, or a mistake would judge itself.
class Law {
 public:
  explicit Law(const haptics::ForceMaterial& material)
      : exponent_(static_cast<int>(std::lround(material.exponent))),
        clamp_(material.clamp_ratio),
        clamp_density_(std::pow(material.clamp_ratio, 1.0 / material.exponent)) {
    assert(exponent_ >= 1 && static_cast<double>(exponent_) == material.exponent);
    assert(clamp_ >= 1.0);  // else the surface itself would be clamped
  }

  /// min(u^e, kappa)
  double pressure(double u) const { return u < clamp_density_ ? power(u, exponent_) : clamp_; }

  /// The integral of `pressure` from 0 to u.
  double potential(double u) const {
    assert(u >= 0.0);
    const double below = std::min(u, clamp_density_);
    return power(below, exponent_ + 1) / (exponent_ + 1) + clamp_ * (u - below);
  }

 private:
  static double power(double u, int e) {
    double result = 1.0;
    for (int i = 0; i < e; ++i) result *= u;
    return result;
  }

  int exponent_;
  double clamp_;
  double clamp_density_;
};

}  // namespace argil::evaluation
