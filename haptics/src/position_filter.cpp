// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/position_filter.h"

#include <cmath>

namespace argil::haptics {
namespace {

constexpr double kNominalPeriodS = 1e-3;

}  // namespace

double gain_for_period(double gain_per_ms, double period_s) noexcept {
  return 1.0 - std::pow(1.0 - gain_per_ms, period_s / kNominalPeriodS);
}

double filter_confidence(double gap_mm, double lambda_mm) noexcept {
  return 1.0 / (gap_mm / lambda_mm + 1.0);
}

Vec3 PositionFilter::filter(const Vec3& position_mm, double period_s) noexcept {
  if (!has_damped_) damped_mm_ = position_mm;
  has_damped_ = true;
  const Vec3 gap = position_mm - damped_mm_;
  damped_mm_ += gain_for_period(options_.gain, period_s) * gap;
  confidence_ = filter_confidence(length(gap), options_.lambda_mm);
  return confidence_ * damped_mm_ + (1.0 - confidence_) * position_mm;
}

}  // namespace argil::haptics
