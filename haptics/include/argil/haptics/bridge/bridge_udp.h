// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "argil/core/result.h"
#include "argil/haptics/bridge/bridge_link.h"

namespace argil::haptics {

/// A BridgeLink over UDP. It is bound to 127.0.0.1 unless it is told another address, so that no
/// other machine can reach it, whatever its network is (BridgeUdp.ListensOnLoopbackOnly).
///
/// Threads  as BridgeLink.
/// Cost     a system call for each receive and each send, 2 to 5 us.
class BridgeUdp final : public BridgeLink {
 public:
  static constexpr std::uint16_t kUsualPort = 47333;

  /// Binds a socket. Port 0: any that is free. Host 0: every address of this machine.
  ///
  /// Errors  device when the port is taken or the system gives no socket.
  static Result<std::unique_ptr<BridgeUdp>> open(const BridgeAddress& at);
  /// The same on loopback.
  static Result<std::unique_ptr<BridgeUdp>> open(std::uint16_t port) {
    return open({kLoopbackHost, port});
  }
  ~BridgeUdp() override;

  /// Where it listens.
  std::uint16_t port() const noexcept { return at_.port; }
  const BridgeAddress& address() const noexcept { return at_; }

  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override;
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override;
  bool wait(double seconds) noexcept override;

 private:
  BridgeUdp(int socket, const BridgeAddress& at) noexcept : socket_(socket), at_(at) {}
  int socket_;
  BridgeAddress at_;
};

}  // namespace argil::haptics
