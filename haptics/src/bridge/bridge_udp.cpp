// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_udp.h"

#include <bit>
#include <cassert>
#include <cerrno>
#include <cmath>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bridge/listen.h"

namespace argil::haptics {

Result<std::unique_ptr<BridgeUdp>> BridgeUdp::open(const BridgeAddress& at) {
  const int handle = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (handle < 0) return cannot_listen(at);
  const std::uint16_t bound = bind_to(handle, at);
  if (bound == 0) {
    const Error error = cannot_listen(at);
    ::close(handle);
    return error;
  }
  return std::unique_ptr<BridgeUdp>(new BridgeUdp(handle, {at.host, bound}));
}

BridgeUdp::~BridgeUdp() { ::close(socket_); }

std::size_t BridgeUdp::receive(std::span<std::byte> into, BridgeAddress& from) noexcept {
  sockaddr_in sender{};
  socklen_t size = sizeof sender;
  ssize_t got = -1;
  do {  // a refusal by a port that was closed is an error of one send, not of this socket
    got = ::recvfrom(socket_, into.data(), into.size(), MSG_TRUNC,
                     std::bit_cast<sockaddr*>(&sender), &size);
  } while (got < 0 && (errno == EINTR || errno == ECONNREFUSED));
  from = {ntohl(sender.sin_addr.s_addr), ntohs(sender.sin_port)};
  if (got < 0) return 0;
  // An empty datagram and one from 127.0.0.2 are not ours; as a single byte they count as
  // malformed.
  const bool is_ours = got > 0 && (at_.host != kLoopbackHost || from.host == kLoopbackHost);
  return is_ours ? static_cast<std::size_t>(got) : 1;
}

void BridgeUdp::send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept {
  const sockaddr_in address = socket_address(to);
  // Lost datagrams are part of the protocol: the next one is newer.
  static_cast<void>(::sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT,
                             std::bit_cast<const sockaddr*>(&address), sizeof address));
}

bool BridgeUdp::wait(double seconds) noexcept {
  assert(seconds >= 0.0);
  pollfd polled{socket_, POLLIN, 0};
  return ::poll(&polled, 1, static_cast<int>(std::ceil(1e3 * seconds))) > 0;
}

}  // namespace argil::haptics
