// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/running_decrement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace argil::haptics {

double RunningDecrement::damping_ratio() const noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return decrement_ / std::sqrt(kTurn * kTurn + decrement_ * decrement_);
}

double RunningDecrement::since_turn_s() const noexcept {
  return has_turn_ ? time_s_ - turn_.time_s : std::numeric_limits<double>::infinity();
}

/// The stroke that leads away from a turn, whose next sample this is.
void RunningDecrement::start_towards(double direction, double position_mm) noexcept {
  direction_ = direction;
  far_mm_ = position_mm;
  before_mm_ = last_mm_;
  after_mm_ = position_mm;
  reached_s_ = time_s_;
  left_s_ = time_s_;
}

/// Where the stroke ended: the top of the parabola through its farthest sample and the two beside
/// it, or the middle of a stretch of equal ones, as counts of an encoder give them.
RunningDecrement::Turn RunningDecrement::extreme() const noexcept {
  assert(left_s_ >= reached_s_);
  Turn turn{far_mm_, 0.5 * (reached_s_ + left_s_)};
  const double bend = before_mm_ - 2.0 * far_mm_ + after_mm_;
  if (left_s_ > reached_s_ || !(std::abs(bend) > 0.0)) return turn;
  const double slope = 0.5 * (after_mm_ - before_mm_);
  turn.position_mm -= 0.5 * slope * slope / bend;
  return turn;
}

bool RunningDecrement::end_stroke(const Turn& turn) noexcept {
  const double height_mm = std::abs(turn.position_mm - turn_.position_mm);
  const double stroke_s = turn.time_s - turn_.time_s;
  const bool swings = has_turn_ && stroke_s >= 0.5 / options_.most_hz &&
                      stroke_s <= slowest_stroke_s() && height_mm > 0.0;
  turn_ = turn;
  has_turn_ = true;
  if (!swings) {
    strokes_ = 0;
    return false;
  }
  heights_mm_[0] = heights_mm_[1];
  heights_mm_[1] = heights_mm_[2];
  heights_mm_[2] = height_mm;
  times_s_[0] = times_s_[1];
  times_s_[1] = stroke_s;
  strokes_ = std::min(strokes_ + 1, 3);
  if (strokes_ < 2) return false;
  decrement_ = strokes_ == 3 ? std::log(heights_mm_[0] / heights_mm_[2])
                             : 2.0 * std::log(heights_mm_[1] / heights_mm_[2]);
  omega_rad_per_s_ = 2.0 * std::numbers::pi / (times_s_[0] + times_s_[1]);
  return true;
}

bool RunningDecrement::add(double position_mm, double period_s) noexcept {
  assert(period_s > 0.0 && std::isfinite(position_mm));
  time_s_ += period_s;
  if (!has_position_) {
    has_position_ = true;
    low_mm_ = high_mm_ = last_mm_ = position_mm;
    return false;
  }
  bool is_new = false;
  if (direction_ == 0.0) {
    low_mm_ = std::min(low_mm_, position_mm);
    high_mm_ = std::max(high_mm_, position_mm);
    // Where it began is no turn.
    if (position_mm - low_mm_ >= options_.least_swing_mm) start_towards(1.0, position_mm);
    if (high_mm_ - position_mm >= options_.least_swing_mm) start_towards(-1.0, position_mm);
  } else {
    const double beyond_mm = direction_ * (position_mm - far_mm_);
    if (beyond_mm > 0.0) {
      start_towards(direction_, position_mm);
    } else if (beyond_mm == 0.0) {
      left_s_ = time_s_;
    } else {
      if (last_mm_ == far_mm_) after_mm_ = position_mm;
      if (-beyond_mm >= options_.least_swing_mm) {
        is_new = end_stroke(extreme());
        start_towards(-direction_, position_mm);
      }
    }
  }
  last_mm_ = position_mm;
  return is_new;
}

}  // namespace argil::haptics
