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

/// 1 - (1 - tau)^(period / 1 ms), without cancellation for small gains.
double gain_of(const PositionFilterOptions& options, double period_s) noexcept {
  if (!(period_s > 0.0)) return 0.0;
  return -std::expm1(period_s / kGainPeriodS * std::log1p(-options.gain));
}

}  // namespace

Result<void> validate(const PositionFilterOptions& options) {
  if (!(options.gain >= PositionFilterOptions::kLeastGain && options.gain <= 1.0)) {
    return bad_option("gain", options.gain, "0.001 to 1");
  }
  if (!(options.lambda_mm > 0.0 && options.lambda_mm <= PositionFilterOptions::kMostLambdaMm)) {
    return bad_option("lambda_mm", options.lambda_mm, "greater than 0 and at most 10");
  }
  return {};
}

double filter_lag_s(const PositionFilterOptions& options, double period_s) noexcept {
  const double gain = gain_of(options, period_s);
  assert(gain > 0.0);
  return period_s * (1.0 - gain) / gain;
}

double most_filter_gap_mm(const PositionFilterOptions& options, double period_s) noexcept {
  return (1.0 - gain_of(options, period_s)) * options.lambda_mm;
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

double PositionFilter::gain_over(double period_s) const noexcept {
  return gain_of(options_, period_s);
}

}  // namespace argil::haptics
