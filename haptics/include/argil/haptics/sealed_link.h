// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "argil/haptics/bridge_key.h"
#include "argil/haptics/bridge_link.h"
#include "argil/haptics/bridge_message.h"

namespace argil::haptics {

/// What was dropped before a byte of it was looked at.
struct SealedCounts {
  std::uint64_t forged = 0;    ///< without the tag that the key makes for the port, or of no length
  std::uint64_t replayed = 0;  ///< not newer than what came from there, or from anywhere at first
};

/// A link whose datagrams end in the key's tag of what they say and of the port that they come
/// from: whoever has not the key is not heard (SealedLink.*). What somebody said who has it is not
/// heard again: from another port its tag is wrong, and sequences must rise, for a sender that is
/// new over all; so senders begin at the time of day in ns.
///
/// Threads  as BridgeLink; no allocation.
/// Cost     two tags of BridgeKey for a message and its answer.
class SealedLink final : public BridgeLink {
 public:
  static constexpr std::size_t kMostBytes = kBridgeMostBytes + BridgeKey::kTagBytes;

  /// `carrier` must outlive it. `self` is who sends by it, and from which port.
  SealedLink(BridgeLink& carrier, const BridgeKey& key, BridgeSender self,
             std::uint16_t port) noexcept
      : carrier_(carrier), key_(key), self_(self), port_(port) {}

  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override;
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override;
  bool wait(double seconds) noexcept override { return carrier_.wait(seconds); }

  const SealedCounts& counts() const noexcept { return counts_; }

 private:
  /// Somebody who has the key, and how far he came.
  struct Sender {
    BridgeAddress address;
    std::uint64_t newest = 0;
  };
  bool is_new(const BridgeAddress& from, std::uint64_t sequence) noexcept;

  BridgeLink& carrier_;
  BridgeKey key_;
  BridgeSender self_;
  std::uint16_t port_;
  SealedCounts counts_;
  std::array<Sender, 8> senders_{};
  std::uint64_t newest_ = 0;  ///< of all
};

}  // namespace argil::haptics
