// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "support/falcon_emulator/usb_bus.h"

namespace argil::test {

/// Lets umockdev hand libusb's calls over to a bus, from this process or from another that was
/// started by it. Not in a program with an `ioctl` of its own.
class UmockdevHandler {
 public:
  explicit UmockdevHandler(UsbBus& bus);  ///< of a device that is plugged in
  ~UmockdevHandler();
  UmockdevHandler(const UmockdevHandler&) = delete;
  UmockdevHandler& operator=(const UmockdevHandler&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace argil::test
