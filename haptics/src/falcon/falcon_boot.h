// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/haptics/falcon/falcon_firmware.h"
#include "argil/haptics/falcon/falcon_status.h"

#include "falcon/falcon_link.h"
#include "falcon/link_clock.h"

namespace argil::haptics {

/// Sets the chip up for the running firmware. `flushes_at_packet_end`: kFtdiEventAtPacketEnd.
FalconFault enter_run_mode(FalconLink& link, bool flushes_at_packet_end);

/// Called with the fraction that is sent, 0 to 1; false ends the upload with FalconFault::none.
using UploadProgress = std::function<bool(double)>;

/// One attempt: resets the processor into its boot loader, greets it, sends the firmware and
/// compares every byte that comes back. Afterwards the firmware runs, with the chip still in the
/// settings of boot mode. Take another link for another attempt.
///
/// Errors  no_greeting; bad_echo (another byte, or none for 250 ms, or not done in 5 s); or the
///         failure of the link.
/// Cost    about a second.
/// Source  docs/theory.md, "Falcon", wire; TI's boot ROM guide (SPRU095) for the stream.
FalconFault upload_falcon_firmware(FalconLink& link, LinkClock& clock,
                                   const FalconFirmware& firmware, const UploadProgress& progress);

}  // namespace argil::haptics
