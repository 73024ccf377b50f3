// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace argil::haptics {

/// Where datagrams come from and go to. A simulator is known by its port on this machine.
///
/// Threads  one: the servo's while it runs. noexcept, no allocation, no lock.
class BridgeLink {
 public:
  virtual ~BridgeLink() = default;
  BridgeLink() = default;
  BridgeLink(const BridgeLink&) = delete;
  BridgeLink& operator=(const BridgeLink&) = delete;

  /// Takes the next datagram that has arrived: its length, more than `into` where it did not fit;
  /// 0 when there is none. Does not wait.
  virtual std::size_t receive(std::span<std::byte> into, std::uint16_t& from_port) noexcept = 0;

  /// Sends, or loses it: nobody is told.
  virtual void send(std::span<const std::byte> datagram, std::uint16_t to_port) noexcept = 0;

  /// Waits until something has arrived, at most so long; false when nothing has.
  virtual bool wait(double seconds) noexcept = 0;
};

}  // namespace argil::haptics
