// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <memory>
#include <span>

#include <libusb.h>

namespace argil::haptics {

// Owners of what libusb gives out. Only falcon_link.cpp sees them.

struct UsbExit {
  void operator()(libusb_context* context) const noexcept { libusb_exit(context); }
};
using UsbContext = std::unique_ptr<libusb_context, UsbExit>;

struct UsbClose {
  void operator()(libusb_device_handle* handle) const noexcept { libusb_close(handle); }
};
using UsbHandle = std::unique_ptr<libusb_device_handle, UsbClose>;

struct UsbFreeTransfer {
  void operator()(libusb_transfer* transfer) const noexcept { libusb_free_transfer(transfer); }
};
using UsbTransfer = std::unique_ptr<libusb_transfer, UsbFreeTransfer>;

/// All devices of a context, referenced while this lives.
class UsbDevices {
 public:
  explicit UsbDevices(libusb_context* context) noexcept
      : count_(libusb_get_device_list(context, &list_)) {}
  ~UsbDevices() {
    if (list_ != nullptr) libusb_free_device_list(list_, 1);
  }
  UsbDevices(const UsbDevices&) = delete;
  UsbDevices& operator=(const UsbDevices&) = delete;

  std::span<libusb_device* const> all() const noexcept {
    return {list_, static_cast<std::size_t>(count_ > 0 ? count_ : 0)};
  }

 private:
  libusb_device** list_ = nullptr;
  ssize_t count_;
};

/// An interface of an opened device, given back when this ends; none until `claim`.
class UsbInterface {
 public:
  UsbInterface() = default;
  ~UsbInterface() {
    if (handle_ != nullptr) libusb_release_interface(handle_, kNumber);
  }
  UsbInterface(const UsbInterface&) = delete;
  UsbInterface& operator=(const UsbInterface&) = delete;

  /// 0 or libusb's error. Once.
  int claim(libusb_device_handle* handle) noexcept {
    assert(handle != nullptr && handle_ == nullptr);
    const int error = libusb_claim_interface(handle, kNumber);
    if (error == LIBUSB_SUCCESS) handle_ = handle;
    return error;
  }

 private:
  static constexpr int kNumber = 0;
  libusb_device_handle* handle_ = nullptr;
};

}  // namespace argil::haptics
