// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "argil/haptics/servo/servo_run.h"

#include "falcon/falcon_session.h"
#include "falcon/link_clock.h"
#include "support/falcon_emulator/testbed.h"
#include "support/falcon_emulator/usb_bus.h"

namespace argil::test {

/// The bus that the calls of libusb go to; null: none. For ioctl_override.cpp.
UsbBus*& connected_bus() noexcept;

/// Time that passes from event to event of the bus as the driver waits for them.
class EmulatedTime final : public haptics::LinkClock {
 public:
  void follow(UsbBus* bus) noexcept { bus_ = bus; }
  void at(double time_s, std::function<void()> action) {
    actions_.emplace(time_s, std::move(action));
  }
  double now_s() noexcept override { return now_s_; }
  double wait_s(double until_s) noexcept override {
    double next_s = std::min(until_s, bus_->next_event_s());
    if (!actions_.empty()) next_s = std::min(next_s, actions_.begin()->first);
    now_s_ = std::max(now_s_, next_s);
    while (!actions_.empty() && actions_.begin()->first <= now_s_) {
      actions_.extract(actions_.begin()).mapped()();
    }
    bus_->advance();
    return 0.0;
  }

 private:
  UsbBus* bus_ = nullptr;
  double now_s_ = 0.0;
  std::multimap<double, std::function<void()>> actions_;
};

/// A Falcon that libusb finds while it is plugged in: on virtual time, or with `is_real_time` on
/// the machine's, with a thread that does what a host controller would.
class EmulatedFalcon {
 public:
  explicit EmulatedFalcon(const DspOptions& options = {}, bool is_real_time = false);
  ~EmulatedFalcon();
  EmulatedFalcon(const EmulatedFalcon&) = delete;
  EmulatedFalcon& operator=(const EmulatedFalcon&) = delete;

  void plug();
  void unplug();

  /// What happens to it at a virtual time.
  void at(double time_s, std::function<void()> action) {
    virtual_time_.at(time_s, std::move(action));
  }

  /// Lets virtual time pass with nobody driving it.
  void pass(double seconds) {
    for (const double end_s = clock().now_s() + seconds; clock().now_s() < end_s;) {
      clock().wait_s(end_s);
    }
  }

  haptics::LinkClock& clock() noexcept;
  UsbBus& bus() noexcept { return *bus_; }

  /// function(dsp, faults, now) with nothing else going on.
  template <class Function>
  auto with(const Function& function) {
    return bus_->with(function);
  }
  template <class Function>
  void set_faults(const Function& function) {
    bus_->with([&](FalconDsp&, FalconFaults& faults, double) { function(faults); });
  }

 private:
  EmulatedTime virtual_time_;
  haptics::SteadyLinkClock real_time_;
  bool is_real_time_;
  std::unique_ptr<UsbBus> bus_;
  std::thread host_;
};

/// The servo's clock where the driver lives on virtual time: waiting runs the driver.
class SessionTime final : public haptics::ServoClock {
 public:
  SessionTime(haptics::FalconSession& session, haptics::LinkClock& clock) noexcept
      : session_(session), clock_(clock) {}
  double now_s() noexcept override { return clock_.now_s(); }
  void wait_until(double time_s) noexcept override { session_.run_until(time_s); }

 private:
  haptics::FalconSession& session_;
  haptics::LinkClock& clock_;
};

}  // namespace argil::test
