// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "argil/core/result.h"
#include "argil/haptics/bridge_link.h"

namespace argil::haptics {

/// UDP on 127.0.0.1. Bound to that address alone, so that no other machine can reach it, whatever
/// its network is (BridgeUdp.ListensOnLoopbackOnly).
///
/// Cost  a system call for each receive and each send, 2 to 5 us.
class BridgeUdp final : public BridgeLink {
 public:
  static constexpr std::uint16_t kUsualPort = 47333;

  /// `port` 0: any that is free.
  /// Errors  device when the port is taken or the system gives no socket.
  static Result<std::unique_ptr<BridgeUdp>> open(std::uint16_t port);
  ~BridgeUdp() override;

  std::uint16_t port() const noexcept { return port_; }

  std::size_t receive(std::span<std::byte> into, std::uint16_t& from_port) noexcept override;
  void send(std::span<const std::byte> datagram, std::uint16_t to_port) noexcept override;
  bool wait(double seconds) noexcept override;

 private:
  BridgeUdp(int socket, std::uint16_t port) noexcept : socket_(socket), port_(port) {}
  int socket_;
  std::uint16_t port_;
};

}  // namespace argil::haptics
