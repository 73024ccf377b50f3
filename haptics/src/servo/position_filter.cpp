// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/position_filter.h"

#include <cassert>
#include <cmath>
#include <sstream>

namespace argil::haptics {
namespace {

/// The period that PositionFilterOptions::gain is for.
constexpr double kGainPeriodS = 1e-3;

Error bad_option(const char* field, double value, const char* remedy) {
  std::ostringstream what;
  what << field << " is " << value << "; must be " << remedy;
  return {ErrorKind::bad_input, what.str()};
}

}  // namespace

Result<void> validate(const PositionFilterOptions& options) {
  if (!(options.gain > 0.0 && options.gain <= 1.0)) {
    return bad_option("gain", options.gain, "greater than 0 and at most 1");
  }
  if (!(std::isfinite(options.lambda_mm) && options.lambda_mm > 0.0)) {
    return bad_option("lambda_mm", options.lambda_mm, "a finite number greater than 0");
  }
  return {};
}

PositionFilter::PositionFilter(const PositionFilterOptions& options) noexcept : options_(options) {
  assert(options.gain > 0.0 && options.gain <= 1.0 && options.lambda_mm > 0.0);
}

Vec3 PositionFilter::filter(const Vec3& position_mm, double period_s) noexcept {
  if (!is_finite(position_mm)) return filtered_mm_;
  if (!has_start_) {
    damped_mm_ = position_mm;
    has_start_ = true;
  }
  const Vec3 gap = position_mm - damped_mm_;
  damped_mm_ += gain_over(period_s) * gap;
  confidence_ = 1.0 / (length(gap) / options_.lambda_mm + 1.0);
  assert(confidence_ >= 0.0 && confidence_ <= 1.0);
  filtered_mm_ = confidence_ * damped_mm_ + (1.0 - confidence_) * position_mm;
  return filtered_mm_;
}

void PositionFilter::reset() noexcept { *this = PositionFilter(options_); }

/// 1 - (1 - tau)^(period / 1 ms), without cancellation for small gains.
double PositionFilter::gain_over(double period_s) const noexcept {
  if (!(period_s > 0.0)) return 0.0;
  return -std::expm1(period_s / kGainPeriodS * std::log1p(-options_.gain));
}

}  // namespace argil::haptics
