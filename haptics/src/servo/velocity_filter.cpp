// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/velocity_filter.h"

#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// Weight of the newest value in a mean whose lag is `lag_s` at any period: on a steady slope a
/// mean with this weight is period (1 - weight) / weight behind.
double weight_of_newest(double period_s, double lag_s) noexcept {
  assert(period_s > 0.0 && lag_s >= 0.0);
  return period_s / (period_s + lag_s);
}

}  // namespace

VelocityFilter::VelocityFilter(double lag_s) noexcept : lag_s_(lag_s) { assert(lag_s >= 0.0); }

Vec3 VelocityFilter::velocity(const Vec3& position_mm, double period_s) noexcept {
  if (period_s > 0.0 && std::isfinite(period_s)) since_s_ += period_s;
  if (!is_finite(position_mm)) return velocity_mm_per_s_;
  if (!has_last_) {
    has_last_ = true;
  } else {
    if (since_s_ < kLeastPeriodS) return velocity_mm_per_s_;
    const Vec3 difference = (position_mm - last_mm_) / since_s_;
    velocity_mm_per_s_ += weight_of_newest(since_s_, lag_s_) * (difference - velocity_mm_per_s_);
  }
  last_mm_ = position_mm;
  since_s_ = 0.0;
  return velocity_mm_per_s_;
}

void VelocityFilter::reset() noexcept { *this = VelocityFilter(lag_s_); }

}  // namespace argil::haptics
