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
  probing,    ///< does its firmware run already?
  uploading,  ///< it does not: the firmware is being sent
  unhomed,    ///< it answers; its arms' indices have to be passed, then the grip pulled out once
  active,
  fault,  ///< as FalconStatus::fault says; no force until it is homed again
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
  force_not_finite,  ///< whoever gives forces gave none that is a number
  other_serial,      ///< one is attached, but none with that serial number
  internal,          ///< the driver itself failed
};
inline constexpr int kFalconFaults = 17;

/// One sentence: what happened and the remedy. "" for none.
const char* falcon_fault_text(FalconFault fault) noexcept;

/// The same, as an error of kind device.
Error falcon_error(FalconFault fault);

/// How a Falcon stands. Trivially copyable.
struct FalconStatus {
  FalconState state = FalconState::closed;
  FalconFault fault = FalconFault::none;
  double uploaded = 0.0;  ///< share of the firmware, 0 to 1
  int attempt = 0;        ///< of sending it, from 1; 0: it ran already

  std::array<std::int16_t, 3> tick{};  ///< encoders
  std::array<bool, 3> is_homed{};
  bool is_pulled_out = false;  ///< has been, since it was homed
  std::uint32_t buttons = 0;   ///< bit 0 right, 1 front, 2 centre, 3 left
  Vec3 position_mm;            ///< about the calibration's centre; means nothing before it is homed
  Vec3 force_n;                ///< asked of the motors last; they may give a share of it
  std::array<std::int16_t, 3> word{};

  std::uint64_t replies = 0;
  std::uint64_t lost_replies = 0;   ///< that did not come in time
  std::uint64_t dropped_bytes = 0;  ///< that belonged to no reply
  bool has_line_error = false;  ///< the serial line reported an overrun, parity or framing error
  double round_trip_s = 0.0;    ///< from a packet to its reply, smoothed; 0: none yet
};

}  // namespace argil::haptics
