// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "argil/haptics/servo/servo_run.h"

namespace argil::haptics {

/// The time that a Falcon's driver lives in.
class LinkClock {
 public:
  virtual ~LinkClock() = default;
  LinkClock() = default;
  LinkClock(const LinkClock&) = delete;
  LinkClock& operator=(const LinkClock&) = delete;

  virtual double now_s() noexcept = 0;

  /// How long the caller may really wait for an event of the bus, in seconds, if it wants to wait
  /// until then. A virtual clock goes there itself, or to an event before it, and says 0.
  virtual double wait_s(double until_s) noexcept = 0;
};

/// The machine's monotonic clock.
class SteadyLinkClock final : public LinkClock {
 public:
  double now_s() noexcept override { return clock_.now_s(); }
  double wait_s(double until_s) noexcept override {
    return std::max(0.0, until_s - clock_.now_s());
  }

 private:
  SteadyClock clock_;
};

}  // namespace argil::haptics
