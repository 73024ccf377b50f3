// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/velocity_filter.h"

#include <cmath>

namespace argil::haptics {

Vec3 VelocityFilter::update(const Vec3& position_mm, double elapsed_s) noexcept {
  if (has_last_ && elapsed_s > 0.0) {
    const Vec3 raw = (position_mm - last_mm_) / elapsed_s;
    const double share = options_.lag_s > 0.0 ? 1.0 - std::exp(-elapsed_s / options_.lag_s) : 1.0;
    velocity_mm_per_s_ += share * (raw - velocity_mm_per_s_);
  }
  if (!has_last_ || elapsed_s > 0.0) last_mm_ = position_mm;
  has_last_ = true;
  return velocity_mm_per_s_;
}

void VelocityFilter::reset() noexcept {
  has_last_ = false;
  velocity_mm_per_s_ = {};
}

double quantisation_buzz_n(double damping_n_s_per_m, double stiffness_n_per_m, double quantum_mm,
                           double period_s) noexcept {
  constexpr double kMPerMm = 1e-3;
  return kMPerMm * quantum_mm * (2.0 * damping_n_s_per_m / period_s + stiffness_n_per_m);
}

}  // namespace argil::haptics
