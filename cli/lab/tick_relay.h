// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/haptics/servo/servo_run.h"

namespace argil::cli::lab {

/// Hands every tick of a servo's thread on to the main one.
class TickRelay final : public haptics::ServoObserver {
 public:
  void after_tick(const haptics::ServoTick& tick) override { ring_.push(tick); }
  /// Main: appends what came since the last call.
  void move_to(std::vector<haptics::ServoTick>& ticks) {
    for (haptics::ServoTick tick; ring_.pop(tick);) ticks.push_back(tick);
  }
  /// Ticks that the main thread took too late.
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }

 private:
  /// Eight seconds at the highest rate in which the main thread does not look.
  haptics::ServoTickRing ring_{std::size_t{1} << 15U};
};

}  // namespace argil::cli::lab
