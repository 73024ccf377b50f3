// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/guided_hand.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

constexpr double kFilterS = 0.005;  ///< 1 / omega
constexpr double kUsualIntervalS = 1.0 / 60.0;
constexpr double kLeastIntervalS = 0.001;
constexpr double kMostIntervalS = 0.050;
constexpr double kMostSpeedMmPerS = 1000.0;

}  // namespace

void GuidedHand::begin_at(const Vec3& place_mm) noexcept {
  assert(is_finite(place_mm));
  targets_.fetch();  // what was set before no longer counts
  target_ = {place_mm, true, false};
  line_mm_ = place_mm_ = place_mm;
  line_mm_per_s_ = velocity_mm_per_s_ = {};
  line_left_s_ = 0.0;
  target_s_ = -1.0;
  has_time_ = false;
}

void GuidedHand::set(const HandTarget& target) noexcept {
  if (!is_finite(target.place_mm)) return;
  targets_.write_slot() = target;
  targets_.publish();
}

/// Aims the line at the newest target.
void GuidedHand::take(double time_s) noexcept {
  if (!targets_.fetch()) return;
  target_ = targets_.read_slot();
  double interval_s = time_s - target_s_;
  if (!(interval_s >= kLeastIntervalS && interval_s <= kMostIntervalS)) {
    interval_s = kUsualIntervalS;
  }
  target_s_ = time_s;
  const Vec3 path_mm = target_.place_mm - line_mm_;
  line_left_s_ = std::max(interval_s, length(path_mm) / kMostSpeedMmPerS);
  assert(line_left_s_ > 0.0);
  line_mm_per_s_ = path_mm / line_left_s_;
}

/// Moves along the line, and the filtered position after it: x'' = (line - x) w^2 - 2 w x', w = 1 /
/// kFilterS.
void GuidedHand::move(double elapsed_s) noexcept {
  assert(elapsed_s > 0.0 && line_left_s_ >= 0.0);
  const double along_s = std::min(elapsed_s, line_left_s_);
  line_left_s_ -= along_s;
  line_mm_ = line_left_s_ > 0.0 ? line_mm_ + along_s * line_mm_per_s_ : target_.place_mm;
  // Exact for a line that stood still meanwhile, so that any step is stable.
  const double steps = elapsed_s / kFilterS;
  const double kept = std::exp(-steps);
  const Vec3 off_mm = place_mm_ - line_mm_;
  const Vec3 slope_mm = kFilterS * velocity_mm_per_s_ + off_mm;
  place_mm_ = line_mm_ + kept * (off_mm + steps * slope_mm);
  velocity_mm_per_s_ = kept / kFilterS * (slope_mm - off_mm - steps * slope_mm);
}

HandIntent GuidedHand::at(double time_s) noexcept {
  if (!has_time_) time_s_ = time_s;
  has_time_ = true;
  take(time_s);
  if (time_s > time_s_) move(time_s - time_s_);
  time_s_ = time_s;
  HandIntent intent;
  intent.place_mm = place_mm_;
  intent.velocity_mm_per_s = velocity_mm_per_s_;
  intent.holds = target_.holds;
  intent.is_active = target_.is_active;
  return intent;
}

}  // namespace argil::haptics
