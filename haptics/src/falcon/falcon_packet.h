// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace argil::haptics {

// The running protocol: 16 bytes out, 16 bytes back, nothing unasked. A packet is '<', 14 letters,
// '>'; a number is four nibbles as letters 'A' to 'P', the lowest first. Frame bytes cannot occur
// between them, which makes it safe to search for the next packet.
//
// Source  docs/theory.md, "Falcon", wire.

inline constexpr std::size_t kFalconPacketBytes = 16;
using FalconPacket = std::array<std::uint8_t, kFalconPacketBytes>;

/// What the host tells the device. By default: no force, no light.
struct FalconCommand {
  std::array<std::int16_t, 3> word{};  ///< motors; -4095 to 4095, clamped when it is encoded
  bool is_homing = false;  ///< look for the arms' indices, and keep the frame that they gave
  bool green = false;
  bool blue = false;
  bool red = false;
};

FalconPacket encode(const FalconCommand& command) noexcept;

/// What the device answers.
struct FalconReply {
  std::array<std::int16_t, 3> tick{};  ///< encoders
  std::uint8_t buttons = 0;            ///< bit 0 right (plus), 1 front, 2 centre, 3 left (minus)
  std::array<bool, 3> is_homed{};

  bool operator==(const FalconReply&) const = default;
  bool all_homed() const noexcept { return is_homed[0] && is_homed[1] && is_homed[2]; }
};

/// Finds replies in a stream that may be cut anywhere and damaged: what is not a packet is skipped
/// up to the next '<'. A short packet never makes a reply.
///
/// Threads  Realtime.
class FalconReplyParser {
 public:
  /// Takes one more byte; the reply that it completes.
  std::optional<FalconReply> push(std::uint8_t byte) noexcept;

  /// Bytes that turned out to belong to no reply.
  std::uint64_t dropped_bytes() const noexcept { return dropped_; }

  void reset() noexcept { filled_ = 0; }  ///< forgets a packet's beginning

 private:
  void drop() noexcept;

  FalconPacket packet_{};
  std::size_t filled_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace argil::haptics
