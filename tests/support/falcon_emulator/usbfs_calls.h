// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/falcon_emulator/usb_bus.h"

namespace argil::test {

/// A call of usbfs but for those that hand a transfer in or out: 0 or more, or negative errno.
/// `argument` points to memory of this process.
int usbfs_call(UsbBus& bus, unsigned request, void* argument);

}  // namespace argil::test
