// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

typedef struct _UMockdevTestbed UMockdevTestbed;

namespace argil::test {

/// A mocked /sys and /dev in which libusb finds a Falcon while one is plugged in. One for a
/// process: libusb remembers where its files are.
class UsbTestbed {
 public:
  static UsbTestbed& instance();
  UsbTestbed(const UsbTestbed&) = delete;
  UsbTestbed& operator=(const UsbTestbed&) = delete;

  void add();                     ///< shows it, and tells who listens
  void remove();                  ///< hides it, and tells who listens
  std::string node_path() const;  ///< of its node, as others than libusb see it
  std::string root() const;
  UMockdevTestbed* get() noexcept { return testbed_; }

 private:
  UsbTestbed();
  UMockdevTestbed* testbed_;
};

}  // namespace argil::test
