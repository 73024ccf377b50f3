// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// How far a Falcon has come. Only an active one gives forces.
enum class FalconState : std::uint8_t {
  closed,
  /// It is asked whether its firmware runs already.
  probing,
  /// It does not run: the firmware is being sent.
  uploading,
  /// It answers. Its arms have to pass their indices, then the grip has to be pulled out once.
  unhomed,
  active,
  /// No force until it is homed again; FalconStatus::fault says why.
  fault,
};
const char* falcon_state_name(FalconState state) noexcept;  ///< "closed", "probing", ...

/// Why a Falcon cannot be used.
enum class FalconFault : std::uint8_t {
  none,
  no_usb,            ///< the machine shows no USB at all
  not_found,         ///< no Falcon is attached
  no_permission,     ///< the system does not let this user open it
  busy,              ///< another program has it
  unplugged,         ///< it has gone
  stalled,           ///< it refuses a transfer
  babbled,           ///< it sent more than it may
  usb_failed,        ///< another failure of a transfer
  no_firmware,       ///< its firmware does not run, and there is none to send
  no_greeting,       ///< its boot loader does not answer
  bad_echo,          ///< what came back of the firmware is not what was sent
  not_started,       ///< the firmware was sent and does not answer
  silent,            ///< it answered and does so no more
  force_not_finite,  ///< it was given a force that is not finite
  other_serial,      ///< one is attached, but none with that serial number
  internal,          ///< the driver itself failed
};
/// How many faults there are, `none` included.
inline constexpr int kFalconFaults = 17;

/// One sentence: what happened and the remedy. "" for `none`.
const char* falcon_fault_text(FalconFault fault) noexcept;

/// The same, as an error of kind device.
Error falcon_error(FalconFault fault);

/// How a Falcon stands. Trivially copyable.
struct FalconStatus {
  FalconState state = FalconState::closed;
  FalconFault fault = FalconFault::none;
  /// Fraction of the firmware that was sent, 0 to 1.
  double uploaded = 0.0;
  /// Of sending it, from 1; 0: it ran already.
  int attempt = 0;

  /// Counts of the three encoders.
  std::array<std::int16_t, 3> tick{};
  std::array<bool, 3> is_homed{};
  /// The grip has been pulled out since it was homed.
  bool is_pulled_out = false;
  /// Of the grip: bit 0 right, 1 front, 2 centre, 3 left. A reading of FalconDevice has another
  /// order.
  std::uint32_t buttons = 0;
  /// About the calibration's centre; means nothing before it is homed.
  Vec3 position_mm;
  /// Last asked of the motors; where they saturate they give a fraction of it.
  Vec3 force_n;
  /// Motor words that were sent last.
  std::array<std::int16_t, 3> word{};

  std::uint64_t replies = 0;
  /// Replies that did not come in time.
  std::uint64_t lost_replies = 0;
  /// Bytes that belonged to no reply.
  std::uint64_t dropped_bytes = 0;
  /// The serial line reported an overrun, parity or framing error.
  bool has_line_error = false;
  /// From a packet to its reply, smoothed; 0: none yet.
  double round_trip_s = 0.0;
};

}  // namespace argil::haptics
