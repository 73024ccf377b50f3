// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/usbfs_calls.h"

#include <cerrno>
#include <cstring>

#include <linux/ioctl.h>

namespace argil::test {
namespace {

int driver_call(UsbBus& bus, const usbdevfs_ioctl& call) {
  switch (static_cast<unsigned>(call.ioctl_code)) {
    case USBDEVFS_DISCONNECT:
      return bus.has_driver() ? bus.claim(true) : -ENODATA;
    case USBDEVFS_CONNECT:
      return bus.attach_driver();
    default:
      return -ENOTTY;
  }
}

}  // namespace

int usbfs_call(UsbBus& bus, unsigned request, void* argument) {
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<__u32*>(argument) = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                       USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                       USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_CLAIMINTERFACE:
      return bus.claim(false);
    case USBDEVFS_DISCONNECT_CLAIM:
      return bus.claim(true);
    case USBDEVFS_RELEASEINTERFACE:
      return bus.release();
    case USBDEVFS_GETDRIVER:
      if (!bus.has_driver()) return -ENODATA;
      std::strcpy(static_cast<usbdevfs_getdriver*>(argument)->driver, "ftdi_sio");
      return 0;
    case USBDEVFS_IOCTL:
      return driver_call(bus, *static_cast<usbdevfs_ioctl*>(argument));
    case USBDEVFS_CLEAR_HALT:
      return bus.clear_halt(*static_cast<const unsigned*>(argument));
    case USBDEVFS_SETINTERFACE:
    case USBDEVFS_SETCONFIGURATION:
    case USBDEVFS_RESET:
      return bus.is_plugged() ? 0 : -ENODEV;
    default:
      return -ENOTTY;
  }
}

}  // namespace argil::test
