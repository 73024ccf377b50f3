// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_watch.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace argil::haptics {

double BridgeWatch::age_s(double now_s) const noexcept {
  return is_heard_ ? now_s - heard_s_ : std::numeric_limits<double>::infinity();
}

double BridgeWatch::tick(double now_s) noexcept {
  const double late_s = age_s(now_s) - options_.hold_s;
  const double most = std::clamp(1.0 - late_s / options_.ramp_out_s, 0.0, 1.0);
  const double rise = std::max(0.0, now_s - last_s_) / options_.ramp_in_s;
  last_s_ = now_s;
  gain_ = std::min(most, gain_ + rise);
  assert(gain_ >= 0.0 && gain_ <= 1.0);
  return gain_;
}

}  // namespace argil::haptics
