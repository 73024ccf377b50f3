// SPDX-License-Identifier: GPL-3.0-or-later
// The program that is built with this file answers libusb's calls to the kernel itself: its own
// `ioctl` stands before the C library's. Calls for anything but the emulated device go on to the
// kernel.
#include <cerrno>
#include <cstdarg>

#include <linux/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "support/falcon_emulator/emulated_falcon.h"
#include "support/falcon_emulator/usbfs_calls.h"

namespace argil::test {
namespace {

int answer(UsbBus& bus, UsbBus::File file, unsigned request, void* argument) {
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      // What libusb asks of a file first. One of that number that was closed before has nothing
      // under way any more.
      bus.forget(file);
      return usbfs_call(bus, request, argument);
    case USBDEVFS_SUBMITURB:
      return bus.submit(static_cast<usbdevfs_urb*>(argument), file);
    case USBDEVFS_DISCARDURB:
      return bus.discard(static_cast<usbdevfs_urb*>(argument));
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY: {
      usbdevfs_urb* urb = bus.reap(file);
      if (urb == nullptr) return bus.is_plugged() ? -EAGAIN : -ENODEV;
      *static_cast<usbdevfs_urb**>(argument) = urb;
      return 0;
    }
    default:
      return usbfs_call(bus, request, argument);
  }
}

}  // namespace
}  // namespace argil::test

// The C library declares it so; readability-identifier-naming has no say in its names.
extern "C" __attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  constexpr unsigned long kUsbfsType = 'U';
  argil::test::UsbBus* bus = argil::test::connected_bus();
  const bool is_usbfs = ((request >> 8U) & 0xFFU) == kUsbfsType;
  if (bus == nullptr || !is_usbfs || !bus->is_node_of(fd)) {
    return static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
  }
  const int result = argil::test::answer(*bus, static_cast<argil::test::UsbBus::File>(fd),
                                         static_cast<unsigned>(request), argument);
  if (result >= 0) return result;
  errno = -result;
  return -1;
}
