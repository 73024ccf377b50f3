// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "argil/haptics/bridge/bridge_key.h"
#include "argil/haptics/bridge/bridge_link.h"
#include "argil/haptics/bridge/bridge_message.h"

namespace argil::haptics {

/// What was dropped before a byte of it was looked at.
struct SealedCounts {
  /// Without the tag that the key makes for the port, or of a length that no message has.
  std::uint64_t forged = 0;
  /// Not newer than what came from that sender or, from a new sender, than all that came.
  std::uint64_t replayed = 0;
};

/// A link whose datagrams end in the key's tag of their content and of the port that they come
/// from: whoever does not have the key is not heard (SealedLink.*). A datagram of somebody who has
/// it cannot be replayed: from another port its tag is wrong, and sequences must rise, those of a
/// new sender above all others; senders therefore begin at the time of day in ns.
///
/// Threads  as BridgeLink; no allocation.
/// Cost     two tags of BridgeKey for a message and its answer.
class SealedLink final : public BridgeLink {
 public:
  static constexpr std::size_t kMostBytes = kBridgeMostBytes + BridgeKey::kTagBytes;

  /// Seals the datagrams of `carrier`, which must outlive it. `self` sends by it, from `port`.
  SealedLink(BridgeLink& carrier, const BridgeKey& key, BridgeSender self,
             std::uint16_t port) noexcept
      : carrier_(carrier), key_(key), self_(self), port_(port) {}

  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override;
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override;
  bool wait(double seconds) noexcept override { return carrier_.wait(seconds); }

  const SealedCounts& counts() const noexcept { return counts_; }

 private:
  /// Somebody who has the key, and the newest sequence from there.
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
