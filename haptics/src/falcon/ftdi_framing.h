// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace argil::haptics {

// The FT232R in front of the Falcon's processor: what its bulk packets and vendor requests mean.
//
// Source  FTDI, "FT232R USB UART IC datasheet", for the chip; docs/theory.md, "Falcon", wire, for
//         what the Falcon needs of it.

inline constexpr std::size_t kFtdiPacketBytes = 64;   ///< of a bulk packet ...
inline constexpr std::size_t kFtdiStatusBytes = 2;    ///< ... of which the chip's status
inline constexpr std::size_t kFtdiPayloadBytes = 62;  ///< ... and the serial line's

/// A vendor request without data: type 0x40, index 0.
struct FtdiRequest {
  std::uint8_t request = 0;
  std::uint16_t value = 0;
};

inline constexpr FtdiRequest kFtdiPurgeIn{0, 1};   ///< forget what came from the device
inline constexpr FtdiRequest kFtdiPurgeOut{0, 2};  ///< and what has not gone to it
inline constexpr FtdiRequest kFtdiDtrLow{1, 0x0100};
inline constexpr FtdiRequest kFtdiDtrHigh{1, 0x0101};
inline constexpr FtdiRequest kFtdiRtsLow{1, 0x0200};
inline constexpr FtdiRequest kFtdiNoFlowControl{2, 0};
inline constexpr FtdiRequest kFtdiBootBaud{3, 0x4138};    ///< 9600
inline constexpr FtdiRequest kFtdiUploadBaud{3, 0x0015};  ///< 142 857, for 140 000
inline constexpr FtdiRequest kFtdiRunBaud{3, 0x0002};     ///< 1.5 million
inline constexpr FtdiRequest kFtdiLine8N1{4, 0x0008};
/// Each '>' sends what is waiting at once. Untested on hardware.
inline constexpr FtdiRequest kFtdiEventAtPacketEnd{6, 0x013E};
/// How long fewer than 62 bytes wait: 1 to 255 ms.
constexpr FtdiRequest ftdi_latency(std::uint8_t ms) noexcept {
  assert(ms > 0);
  return {9, ms};
}

/// What the status bytes of one transfer said.
struct FtdiStatus {
  bool is_clear_to_send = false;  ///< of the last packet
  bool has_line_error = false;    ///< overrun, parity or framing, in any packet
};

/// Takes the status bytes out of a bulk IN transfer, each 64 bytes of which are a packet of their
/// own. A transfer of nothing but status is what an idle chip sends: no payload, no error.
///
/// Shapes   transfer: any length; the payload is moved to its front.
/// Returns  bytes of payload. `status` stays as it was when there was no packet.
/// Threads  Realtime.
std::size_t strip_ftdi_status(std::span<std::uint8_t> transfer, FtdiStatus& status) noexcept;

}  // namespace argil::haptics
