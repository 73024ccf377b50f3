// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/falcon_packet.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "argil/haptics/falcon/falcon_kinematics.h"

namespace argil::haptics {
namespace {

constexpr std::uint8_t kBegin = 0x3C;
constexpr std::uint8_t kEnd = 0x3E;
constexpr std::uint8_t kLetter = 0x41;  ///< of nibble 0
constexpr std::size_t kNumbersEnd = 13;
constexpr std::size_t kFlags = 13;
constexpr std::size_t kUnknown = 14;
constexpr std::size_t kLast = 15;

void put_number(FalconPacket& packet, std::size_t index, int value) noexcept {
  assert(index < 3 && std::abs(value) <= kFalconLargestWord);
  const auto bits = static_cast<std::uint16_t>(value);
  for (std::size_t nibble = 0; nibble < 4; ++nibble) {
    packet[1 + 4 * index + nibble] =
        static_cast<std::uint8_t>(kLetter + ((bits >> (4 * nibble)) & 0xFU));
  }
}

std::int16_t number_at(const FalconPacket& packet, std::size_t index) noexcept {
  assert(index < 3);
  unsigned bits = 0;
  for (std::size_t nibble = 0; nibble < 4; ++nibble) {
    bits |= static_cast<unsigned>(packet[1 + 4 * index + nibble] - kLetter) << (4 * nibble);
  }
  return static_cast<std::int16_t>(bits);
}

/// Whether a reply may have this byte at this index.
bool may_stand(std::size_t at, std::uint8_t byte) noexcept {
  if (at == 0) return byte == kBegin;
  if (at < kNumbersEnd) return byte >= kLetter && byte <= kLetter + 0xF;
  if (at == kFlags) return byte >= kLetter && byte <= kLetter + 0x7F;
  if (at == kUnknown) return byte != kBegin && byte != kEnd;
  return byte == kEnd;
}

FalconReply reply_of(const FalconPacket& packet) noexcept {
  FalconReply reply;
  const unsigned flags = packet[kFlags] - kLetter;
  reply.buttons = static_cast<std::uint8_t>(flags & 0xFU);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    reply.tick[leg] = number_at(packet, leg);
    reply.is_homed[leg] = (flags >> (4 + leg) & 1U) != 0;
  }
  return reply;
}

}  // namespace

FalconPacket encode(const FalconCommand& command) noexcept {
  FalconPacket packet;
  packet[0] = kBegin;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    put_number(packet, leg,
               std::clamp<int>(command.word[leg], -kFalconLargestWord, kFalconLargestWord));
  }
  const unsigned flags = (command.is_homing ? 1U : 0U) | (command.green ? 2U : 0U) |
                         (command.blue ? 4U : 0U) | (command.red ? 8U : 0U);
  packet[kFlags] = static_cast<std::uint8_t>(kLetter + flags);
  packet[kUnknown] = kLetter;
  packet[kLast] = kEnd;
  return packet;
}

void FalconReplyParser::drop() noexcept {
  dropped_ += filled_;
  filled_ = 0;
}

std::optional<FalconReply> FalconReplyParser::push(std::uint8_t byte) noexcept {
  if (byte == kBegin) drop();
  if (!may_stand(filled_, byte)) {
    drop();
    ++dropped_;
    return std::nullopt;
  }
  assert(filled_ < packet_.size());
  packet_[filled_++] = byte;
  if (filled_ < kFalconPacketBytes) return std::nullopt;
  filled_ = 0;
  return reply_of(packet_);
}

}  // namespace argil::haptics
