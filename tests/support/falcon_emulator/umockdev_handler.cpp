// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/umockdev_handler.h"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <linux/ioctl.h>
#include <umockdev.h>

#include "support/falcon_emulator/testbed.h"
#include "support/falcon_emulator/usbfs_calls.h"

namespace argil::test {
namespace {

constexpr const char* kNode = "/dev/bus/usb/001/002";

struct Unref {
  void operator()(UMockdevIoctlData* data) const noexcept { umockdev_ioctl_data_unref(data); }
};
using Data = std::unique_ptr<UMockdevIoctlData, Unref>;

/// The caller's memory behind a pointer in ours; null where there is none.
Data resolve(UMockdevIoctlData* data, std::size_t offset, std::size_t size) {
  return Data(umockdev_ioctl_data_resolve(data, offset, size, nullptr));
}

}  // namespace

struct UmockdevHandler::Impl {
  /// A transfer's struct and bytes, kept until the caller has it back.
  struct Flying {
    Data urb;
    Data bytes;
    UMockdevIoctlClient* client = nullptr;
  };

  explicit Impl(UsbBus& to) : bus(to) {}

  static UsbBus::File file_of(UMockdevIoctlClient* client) {
    return reinterpret_cast<UsbBus::File>(client);
  }

  int submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    Flying flying;
    flying.client = client;
    flying.urb = resolve(argument, 0, sizeof(usbdevfs_urb));
    auto* urb = reinterpret_cast<usbdevfs_urb*>(flying.urb->data);
    flying.bytes = resolve(flying.urb.get(), offsetof(usbdevfs_urb, buffer),
                           static_cast<std::size_t>(urb->buffer_length));
    all[urb] = std::move(flying);
    const int result = bus.submit(urb, file_of(client));
    if (result < 0) all.erase(urb);
    return result;
  }

  int reap(UMockdevIoctlClient* client, UMockdevIoctlData* argument, Flying& reaped) {
    usbdevfs_urb* urb = bus.reap(file_of(client));
    if (urb == nullptr) return bus.is_plugged() ? -EAGAIN : -ENODEV;
    reaped = std::move(all[urb]);
    all.erase(urb);
    const Data slot = resolve(argument, 0, sizeof(void*));
    return umockdev_ioctl_data_set_ptr(slot.get(), 0, reaped.urb.get()) != 0 ? 0 : -EFAULT;
  }

  int discard(UMockdevIoctlData* argument) {
    gulong address = 0;
    std::memcpy(&address, argument->data, sizeof address);
    for (const auto& [urb, flying] : all) {
      if (flying.urb->client_addr == address) return bus.discard(urb);
    }
    return -EINVAL;
  }

  int answer(UMockdevIoctlClient* client, unsigned request, Flying& reaped) {
    UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
    switch (request) {
      case USBDEVFS_SUBMITURB:
        return submit(client, argument);
      case USBDEVFS_REAPURB:
      case USBDEVFS_REAPURBNDELAY:
        return reap(client, argument, reaped);
      case USBDEVFS_DISCARDURB:
        return discard(argument);
      default:
        break;
    }
    const std::size_t size = _IOC_SIZE(request);
    if (size == 0) return usbfs_call(bus, request, nullptr);
    const Data data = resolve(argument, 0, size);
    return usbfs_call(bus, request, data->data);
  }

  static gboolean on_ioctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client,
                           gpointer user) {
    auto& self = *static_cast<Impl*>(user);
    const auto request = static_cast<unsigned>(umockdev_ioctl_client_get_request(client));
    if (((request >> 8U) & 0xFFU) != 'U') return 0;
    Flying reaped;  // until its bytes have gone back
    const int result = self.answer(client, request, reaped);
    umockdev_ioctl_client_complete(client, result < 0 ? -1 : result, result < 0 ? -result : 0);
    return 1;
  }

  /// umockdev 0.17 may lose its last reference to a caller that still waits for an answer.
  static void on_connected(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client,
                           gpointer user) {
    static_cast<Impl*>(user)->clients.push_back(UMOCKDEV_IOCTL_CLIENT(g_object_ref(client)));
  }

  /// As the kernel does when a device's file is closed.
  static void on_vanished(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user) {
    auto& self = *static_cast<Impl*>(user);
    self.bus.forget(file_of(client));
    std::erase_if(self.all, [&](const auto& entry) { return entry.second.client == client; });
  }

  UsbBus& bus;
  UMockdevIoctlBase* base = nullptr;
  std::vector<UMockdevIoctlClient*> clients;
  std::map<usbdevfs_urb*, Flying> all;
};

UmockdevHandler::UmockdevHandler(UsbBus& bus) : impl_(std::make_unique<Impl>(bus)) {
  impl_->base = umockdev_ioctl_base_new();
  g_signal_connect(impl_->base, "handle-ioctl", G_CALLBACK(&Impl::on_ioctl), impl_.get());
  g_signal_connect(impl_->base, "client-connected", G_CALLBACK(&Impl::on_connected), impl_.get());
  g_signal_connect(impl_->base, "client-vanished", G_CALLBACK(&Impl::on_vanished), impl_.get());
  GError* error = nullptr;
  umockdev_testbed_attach_ioctl(UsbTestbed::instance().get(), kNode, impl_->base, &error);
  if (error != nullptr) throw std::runtime_error(error->message);
}

UmockdevHandler::~UmockdevHandler() {
  umockdev_testbed_detach_ioctl(UsbTestbed::instance().get(), kNode, nullptr);
  g_object_unref(impl_->base);
  for (UMockdevIoctlClient* client : impl_->clients) g_object_unref(client);
}

}  // namespace argil::test
