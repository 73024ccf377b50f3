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

/// An end of the wire. The default is none.
struct BridgeAddress {
  std::uint32_t host = 0;  ///< IPv4, in the processor's byte order
  std::uint16_t port = 0;
  friend auto operator<=>(const BridgeAddress&, const BridgeAddress&) = default;
};

/// This machine, 127.0.0.1, which no other machine can reach.
inline constexpr std::uint32_t kLoopbackHost = 0x7F000001;

/// A host as people write it: 192.168.0.7.
std::string host_text(std::uint32_t host);
/// And back; nothing when it is not one.
std::optional<std::uint32_t> host_of(const std::string& text);

/// Where datagrams come from and go to. A simulator is known by its address.
///
/// Errors   none: a datagram that is lost is not reported, since the next one is newer.
/// Threads  one: the servo's while it runs. noexcept, no allocation, no lock.
class BridgeLink {
 public:
  /// Returned for a datagram that the link has rejected, and counted.
  static constexpr std::size_t kDropped = std::numeric_limits<std::size_t>::max();

  virtual ~BridgeLink() = default;
  BridgeLink() = default;
  BridgeLink(const BridgeLink&) = delete;
  BridgeLink& operator=(const BridgeLink&) = delete;

  /// Takes the next datagram that has arrived: its length, which is more than `into` where it did
  /// not fit; kDropped; 0 when there is none. Does not wait.
  virtual std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept = 0;

  /// Sends it, or loses it.
  virtual void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept = 0;

  /// Waits until something has arrived, at most `seconds`; false when nothing has.
  virtual bool wait(double seconds) noexcept = 0;
};

}  // namespace argil::haptics
