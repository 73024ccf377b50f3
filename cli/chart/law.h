// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "argil/haptics/tool_force.h"

namespace argil::cli::chart {

/// The laws of docs/forces.md for a whole exponent, written a second time: what judges the engine's
/// sums shares no code with them.
class Law {
 public:
  explicit Law(const haptics::ForceMaterial& material)
      : exponent_(static_cast<int>(std::lround(material.exponent))),
        clamp_(material.clamp_ratio),
        clamp_density_(std::pow(material.clamp_ratio, 1.0 / material.exponent)) {}

  /// min(u^e, kappa)
  double pressure(double u) const { return u < clamp_density_ ? power(u, exponent_) : clamp_; }

  /// The integral of `pressure` from 0 to u.
  double potential(double u) const {
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

}  // namespace argil::cli::chart
