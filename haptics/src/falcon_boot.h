// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/haptics/falcon_firmware.h"
#include "argil/haptics/falcon_status.h"

#include "falcon_link.h"
#include "link_clock.h"

namespace argil::haptics {

/// Sets the chip up for the running firmware. `flushes_at_packet_end`: kFtdiEventAtPacketEnd.
FalconFault enter_run_mode(FalconLink& link, bool flushes_at_packet_end);

/// Told the share that is sent, 0 to 1; false ends the upload with FalconFault::none.
using UploadProgress = std::function<bool(double)>;

/// One attempt: resets the processor into its boot loader, greets it, sends the firmware and
/// compares what comes back of every byte. Afterwards the firmware runs, in boot mode's settings.
///
/// Errors  no_greeting, bad_echo (another byte, or none for 250 ms, or not done in 5 s), or what
/// the
///         link met. Take another link for another attempt.
/// Cost    about a second.
/// Source  ../shared/facts/falcon.md section 3.
FalconFault upload_falcon_firmware(FalconLink& link, LinkClock& clock,
                                   const FalconFirmware& firmware, const UploadProgress& progress);

}  // namespace argil::haptics
