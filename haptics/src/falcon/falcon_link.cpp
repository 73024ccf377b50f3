// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "argil/haptics/falcon/falcon_device.h"

#include "falcon/usb_handles.h"

namespace argil::haptics {
namespace {

constexpr std::uint16_t kVendor = 0x0403;
constexpr std::uint16_t kProduct = 0xCB48;
constexpr unsigned char kEndpointOut = 0x02;
constexpr unsigned char kEndpointIn = 0x81;
constexpr std::uint8_t kVendorRequestOut = 0x40;
constexpr unsigned kControlMs = 1000;
/// The kernel gives back a cancelled transfer at once; nothing may wait for it for ever.
constexpr double kMostCancelS = 1.0;

FalconFault fault_of_error(int error) noexcept {
  switch (error) {
    case LIBUSB_SUCCESS:
      return FalconFault::none;
    case LIBUSB_ERROR_ACCESS:
      return FalconFault::no_permission;
    case LIBUSB_ERROR_BUSY:
      return FalconFault::busy;
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return FalconFault::unplugged;
    case LIBUSB_ERROR_PIPE:
      return FalconFault::stalled;
    case LIBUSB_ERROR_OVERFLOW:
      return FalconFault::babbled;
    default:
      return FalconFault::usb_failed;
  }
}

FalconFault fault_of_status(libusb_transfer_status status) noexcept {
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
    case LIBUSB_TRANSFER_CANCELLED:
      return FalconFault::none;
    case LIBUSB_TRANSFER_STALL:
      return FalconFault::stalled;
    case LIBUSB_TRANSFER_NO_DEVICE:
      return FalconFault::unplugged;
    case LIBUSB_TRANSFER_OVERFLOW:
      return FalconFault::babbled;
    case LIBUSB_TRANSFER_ERROR:
    case LIBUSB_TRANSFER_TIMED_OUT:
      break;
  }
  return FalconFault::usb_failed;
}

UsbContext usb_context() {
  libusb_context* context = nullptr;
  if (libusb_init(&context) != LIBUSB_SUCCESS) return nullptr;
  return UsbContext(context);
}

bool is_falcon(libusb_device* device) {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS &&
         descriptor.idVendor == kVendor && descriptor.idProduct == kProduct;
}

std::string serial_of(libusb_device_handle* handle) {
  libusb_device_descriptor descriptor{};
  std::array<unsigned char, 128> text{};
  libusb_get_device_descriptor(libusb_get_device(handle), &descriptor);
  if (descriptor.iSerialNumber == 0) return "";
  const int length = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber,
                                                        text.data(), static_cast<int>(text.size()));
  return length > 0 ? std::string(text.data(), text.data() + length) : "";
}

FalconFault open_device(libusb_device* device, UsbHandle& opened) {
  libusb_device_handle* handle = nullptr;
  const FalconFault fault = fault_of_error(libusb_open(device, &handle));
  opened.reset(handle);
  return fault;
}

/// Takes the interface, from the kernel's driver where that has it.
FalconFault claim(libusb_device_handle* handle, UsbInterface& claimed) {
  // The kernel's serial driver does not know this device unless someone told it to.
  libusb_set_auto_detach_kernel_driver(handle, 1);
  return fault_of_error(claimed.claim(handle));
}

/// What to tell of several that cannot be used: the first real obstacle.
bool says_more(FalconFault fault, FalconFault than) noexcept {
  const auto is_obstacle = [](FalconFault one) {
    return one != FalconFault::not_found && one != FalconFault::other_serial;
  };
  return than == FalconFault::not_found || (!is_obstacle(than) && is_obstacle(fault));
}

}  // namespace

/// An opened and claimed device. Members end in the order that libusb needs.
struct OpenedFalcon {
  UsbHandle handle;
  UsbInterface claimed;

  /// Takes this one if it has that serial number, "" for any.
  FalconFault open(libusb_device* device, const std::string& serial) {
    if (const FalconFault fault = open_device(device, handle); fault != FalconFault::none) {
      return fault;
    }
    if (!serial.empty() && serial_of(handle.get()) != serial) return FalconFault::other_serial;
    return claim(handle.get(), claimed);
  }
};

struct FalconLink::Usb {
  /// One transfer with its memory; what libusb calls back with.
  struct Slot {
    UsbTransfer transfer;
    std::array<std::uint8_t, kFtdiPacketBytes> bytes{};
    FalconLink* link = nullptr;
    bool is_pending = false;
  };

  // What follows uses what stands before it.
  UsbContext context;
  OpenedFalcon opened;
  std::array<Slot, 2> in;
  Slot out;
  bool is_closing = false;  ///< what comes in is not asked for again

  std::array<Slot*, 3> slots() noexcept { return {in.data(), in.data() + 1, &out}; }
  bool is_pending() noexcept {
    const auto all = slots();
    return std::any_of(all.begin(), all.end(), [](const Slot* slot) { return slot->is_pending; });
  }
  /// 0 or libusb's error.
  int handle_events(double most_s) const noexcept {
    assert(most_s >= 0.0);
    const auto us = static_cast<std::int64_t>(std::ceil(1e6 * most_s));
    timeval wait{};
    wait.tv_sec = us / 1'000'000;
    wait.tv_usec = us % 1'000'000;
    return libusb_handle_events_timeout_completed(context.get(), &wait, nullptr);
  }
  FalconFault submit(Slot& slot) noexcept {
    const int error = libusb_submit_transfer(slot.transfer.get());
    slot.is_pending = error == LIBUSB_SUCCESS;
    return fault_of_error(error);
  }
  /// Starts a transfer to the device; not while another is pending, whose memory the kernel reads.
  FalconFault begin_out(std::span<const std::uint8_t> bytes) noexcept;
  void cancel_all() noexcept;

  static void take_in(Slot& slot);
  static void LIBUSB_CALL on_in(libusb_transfer* transfer) noexcept;
  static void LIBUSB_CALL on_out(libusb_transfer* transfer) noexcept;
};

FalconFault FalconLink::Usb::begin_out(std::span<const std::uint8_t> bytes) noexcept {
  if (out.is_pending) return FalconFault::usb_failed;
  assert(bytes.size() <= out.bytes.size());
  std::copy(bytes.begin(), bytes.end(), out.bytes.begin());
  libusb_fill_bulk_transfer(out.transfer.get(), opened.handle.get(), kEndpointOut, out.bytes.data(),
                            static_cast<int>(bytes.size()), on_out, &out, 0);
  return submit(out);
}

void FalconLink::Usb::cancel_all() noexcept {
  is_closing = true;
  for (Slot* slot : slots()) {
    if (slot->is_pending) libusb_cancel_transfer(slot->transfer.get());
  }
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::duration<double> most(kMostCancelS);
  // Asked once more after that time: the machine may have been away for all of it.
  for (bool is_over = false; is_pending() && !is_over; handle_events(0.01)) {
    is_over = std::chrono::steady_clock::now() - begin >= most;
  }
  for (Slot* slot : slots()) {
    // Better leaked than freed while the kernel may still write to it.
    if (slot->is_pending) static_cast<void>(slot->transfer.release());
  }
}

/// Takes what an IN transfer brought into the link's bytes, and submits it again.
void FalconLink::Usb::take_in(Slot& slot) {
  assert(slot.link != nullptr && !slot.is_pending);
  FalconLink& link = *slot.link;
  const libusb_transfer& transfer = *slot.transfer;
  if (transfer.status == LIBUSB_TRANSFER_CANCELLED) return;
  if (link.failure_ == FalconFault::none) link.failure_ = fault_of_status(transfer.status);
  if (transfer.status != LIBUSB_TRANSFER_COMPLETED) return;
  const auto arrived =
      std::span(slot.bytes).first(static_cast<std::size_t>(transfer.actual_length));
  ++link.packets_;
  const std::size_t kept = strip_ftdi_status(arrived, link.status_);
  link.received_.insert(link.received_.end(), arrived.begin(),
                        arrived.begin() + static_cast<std::ptrdiff_t>(kept));
  if (link.usb_->is_closing) return;
  const FalconFault fault = link.usb_->submit(slot);
  if (link.failure_ == FalconFault::none) link.failure_ = fault;
}

void LIBUSB_CALL FalconLink::Usb::on_in(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  slot.is_pending = false;
  try {
    take_in(slot);
  } catch (...) {  // libusb knows none
    slot.link->failure_ = FalconFault::internal;
  }
}

void LIBUSB_CALL FalconLink::Usb::on_out(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  slot.is_pending = false;
  FalconLink& link = *slot.link;
  if (link.failure_ == FalconFault::none) link.failure_ = fault_of_status(transfer->status);
}

Result<std::unique_ptr<FalconLink>, FalconFault> FalconLink::open(const std::string& serial,
                                                                  LinkClock& clock) {
  auto usb = std::make_unique<Usb>();
  usb->context = usb_context();
  if (!usb->context) return FalconFault::no_usb;
  const UsbDevices devices(usb->context.get());
  FalconFault fault = FalconFault::not_found;
  for (libusb_device* device : devices.all()) {
    if (!is_falcon(device)) continue;
    const FalconFault obstacle = usb->opened.open(device, serial);
    if (obstacle == FalconFault::none || says_more(obstacle, fault)) fault = obstacle;
    if (obstacle == FalconFault::none) break;
  }
  if (fault != FalconFault::none) return fault;
  std::unique_ptr<FalconLink> link(new FalconLink(std::move(usb), clock));
  if (const FalconFault begun = link->begin_reading(); begun != FalconFault::none) return begun;
  return link;
}

FalconLink::FalconLink(std::unique_ptr<Usb> usb, LinkClock& clock)
    : usb_(std::move(usb)), clock_(clock) {
  received_.reserve(4 * kFtdiPacketBytes);
}

FalconFault FalconLink::begin_reading() {
  libusb_device_handle* handle = usb_->opened.handle.get();
  for (Usb::Slot* slot : usb_->slots()) {
    slot->link = this;
    slot->transfer.reset(libusb_alloc_transfer(0));
    if (!slot->transfer) return failure_ = FalconFault::usb_failed;
  }
  for (Usb::Slot& slot : usb_->in) {
    libusb_fill_bulk_transfer(slot.transfer.get(), handle, kEndpointIn, slot.bytes.data(),
                              static_cast<int>(slot.bytes.size()), Usb::on_in, &slot, 0);
    failure_ = usb_->submit(slot);
    if (failure_ != FalconFault::none) return failure_;
  }
  return FalconFault::none;
}

FalconLink::~FalconLink() {
  usb_->cancel_all();
  if (failure_ != FalconFault::stalled) return;
  // An endpoint stays stalled until it is told otherwise, for the next link as well.
  libusb_clear_halt(usb_->opened.handle.get(), kEndpointIn);
  libusb_clear_halt(usb_->opened.handle.get(), kEndpointOut);
}

FalconFault FalconLink::control(FtdiRequest request) {
  if (failure_ != FalconFault::none) return failure_;
  const int done =
      libusb_control_transfer(usb_->opened.handle.get(), kVendorRequestOut, request.request,
                              request.value, 0, nullptr, 0, kControlMs);
  // A transfer in flight may have failed meanwhile; that stands.
  if (done < 0 && failure_ == FalconFault::none) failure_ = fault_of_error(done);
  return failure_;
}

FalconFault FalconLink::send(std::span<const std::uint8_t> bytes) {
  assert(!bytes.empty() && bytes.size() <= kFtdiPayloadBytes);
  if (failure_ != FalconFault::none) return failure_;
  return failure_ = usb_->begin_out(bytes);
}

/// Unlike wait_until it waits on when something else has failed. False when it is still sending.
bool FalconLink::wait_for_out(double until_s) noexcept {
  while (usb_->out.is_pending && clock_.now_s() < until_s) {
    usb_->handle_events(clock_.wait_s(until_s));
  }
  return !usb_->out.is_pending;
}

bool FalconLink::send_last(std::span<const std::uint8_t> bytes, double most_s) noexcept {
  assert(!bytes.empty() && bytes.size() <= kFtdiPayloadBytes);
  const double until_s = clock_.now_s() + most_s;
  if (failure_ == FalconFault::unplugged || !wait_for_out(until_s)) return false;
  if (failure_ == FalconFault::stalled) libusb_clear_halt(usb_->opened.handle.get(), kEndpointOut);
  if (usb_->begin_out(bytes) != FalconFault::none || !wait_for_out(until_s)) return false;
  return usb_->out.transfer->status == LIBUSB_TRANSFER_COMPLETED;
}

bool FalconLink::is_sending() const noexcept { return usb_->out.is_pending; }

FalconFault FalconLink::wait_until(double until_s) {
  if (failure_ != FalconFault::none) return failure_;
  const int error = usb_->handle_events(clock_.wait_s(until_s));
  const bool is_bad =
      error != LIBUSB_SUCCESS && error != LIBUSB_ERROR_INTERRUPTED && error != LIBUSB_ERROR_TIMEOUT;
  if (is_bad && failure_ == FalconFault::none) failure_ = fault_of_error(error);
  return failure_;
}

Result<std::vector<AttachedFalcon>> attached_falcons() {
  const UsbContext context = usb_context();
  if (!context) return falcon_error(FalconFault::no_usb);
  const UsbDevices devices(context.get());
  std::vector<AttachedFalcon> attached;
  for (libusb_device* device : devices.all()) {
    if (!is_falcon(device)) continue;
    AttachedFalcon falcon;
    falcon.bus = libusb_get_bus_number(device);
    falcon.address = libusb_get_device_address(device);
    OpenedFalcon opened;
    falcon.obstacle = open_device(device, opened.handle);
    if (falcon.obstacle == FalconFault::none) {
      falcon.serial = serial_of(opened.handle.get());
      falcon.obstacle = claim(opened.handle.get(), opened.claimed);
    }
    attached.push_back(std::move(falcon));
  }
  return attached;
}

}  // namespace argil::haptics
