// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "argil/core/spsc_ring.h"
#include "argil/haptics/bridge/bridge_link.h"
#include "argil/haptics/bridge/bridge_message.h"

namespace argil::python {

/// A bridge's link to one simulator in the same process: two rings instead of a socket.
///
/// Threads  the members of BridgeLink: the servo's; the others: one thread of the simulator's.
///          receive and send are wait-free.
class MemoryLink final : public haptics::BridgeLink {
 public:
  /// Longer than any message is not taken.
  struct Datagram {
    std::array<std::byte, haptics::kBridgeMostBytes> bytes{};
    std::size_t size = 0;
  };

  std::size_t receive(std::span<std::byte> into, haptics::BridgeAddress& from) noexcept override;
  void send(std::span<const std::byte> datagram,
            const haptics::BridgeAddress& to) noexcept override;
  bool wait(double seconds) noexcept override;

  /// To the bridge. False: too long, or the bridge takes nothing.
  bool put(std::span<const std::byte> datagram) noexcept;
  /// What the bridge sent next; nothing when there is none.
  std::optional<Datagram> take() noexcept;
  /// Waits until there is something to take, at most `seconds`.
  bool wait_to_take(double seconds) noexcept;

 private:
  /// A second of states, for a simulator that is held up.
  static constexpr std::size_t kRingDatagrams = 1024;

  SpscRing<Datagram> to_bridge_{kRingDatagrams};
  SpscRing<Datagram> to_simulator_{kRingDatagrams};
  std::atomic<std::uint64_t> put_{0};
  std::atomic<std::uint64_t> received_{0};
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> taken_{0};
};

}  // namespace argil::python
