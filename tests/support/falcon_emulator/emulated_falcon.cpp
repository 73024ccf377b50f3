// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/emulated_falcon.h"

namespace argil::test {

UsbBus*& connected_bus() noexcept {
  static UsbBus* bus = nullptr;
  return bus;
}

EmulatedFalcon::EmulatedFalcon(const DspOptions& options, bool is_real_time)
    : is_real_time_(is_real_time),
      bus_(std::make_unique<UsbBus>(options, [this] { return clock().now_s(); })) {
  UsbTestbed::instance();
  connected_bus() = bus_.get();
  if (is_real_time_) {
    host_ = std::thread([this] { bus_->run_in_real_time(); });
  } else {
    virtual_time_.follow(bus_.get());
  }
  plug();
}

EmulatedFalcon::~EmulatedFalcon() {
  if (bus_->is_plugged()) unplug();
  bus_->stop();
  if (host_.joinable()) host_.join();
  connected_bus() = nullptr;
}

haptics::LinkClock& EmulatedFalcon::clock() noexcept {
  if (is_real_time_) return real_time_;
  return virtual_time_;
}

void EmulatedFalcon::plug() {
  UsbTestbed& testbed = UsbTestbed::instance();
  testbed.add();
  bus_->plug(testbed.node_path());
}

void EmulatedFalcon::unplug() {
  // First the bus: who hears that it is gone asks at once.
  bus_->unplug();
  UsbTestbed::instance().remove();
}

}  // namespace argil::test
