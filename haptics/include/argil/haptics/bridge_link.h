// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace argil::haptics {

/// An end of the wire.
struct BridgeAddress {
  std::uint32_t host = 0;  ///< IPv4, in the processor's byte order
  std::uint16_t port = 0;
  friend auto operator<=>(const BridgeAddress&, const BridgeAddress&) = default;
};

/// This machine, 127.0.0.1, which no other reaches.
inline constexpr std::uint32_t kLoopbackHost = 0x7F000001;

/// A host as people write it, 192.168.0.7, and back.
std::string host_text(std::uint32_t host);
std::optional<std::uint32_t> host_of(const std::string& text);

/// Where datagrams come from and go to. A simulator is known by its address.
///
/// Threads  one: the servo's while it runs. noexcept, no allocation, no lock.
class BridgeLink {
 public:
  /// Of a datagram that arrived and is nobody's business: the link has counted it.
  static constexpr std::size_t kDropped = std::numeric_limits<std::size_t>::max();

  virtual ~BridgeLink() = default;
  BridgeLink() = default;
  BridgeLink(const BridgeLink&) = delete;
  BridgeLink& operator=(const BridgeLink&) = delete;

  /// Takes the next datagram that has arrived: its length, more than `into` where it did not fit;
  /// kDropped; 0 when there is none. Does not wait.
  virtual std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept = 0;

  /// Sends, or loses it: nobody is told.
  virtual void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept = 0;

  /// Waits until something has arrived, at most so long; false when nothing has.
  virtual bool wait(double seconds) noexcept = 0;
};

}  // namespace argil::haptics
