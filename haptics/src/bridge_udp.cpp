// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge_udp.h"

#include <bit>
#include <cerrno>
#include <cmath>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "loopback.h"

namespace argil::haptics {
Result<std::unique_ptr<BridgeUdp>> BridgeUdp::open(std::uint16_t port) {
  const int handle = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (handle < 0) return cannot_listen(port);
  const std::uint16_t bound = bind_to_loopback(handle, port);
  if (bound == 0) {
    const Error error = cannot_listen(port);
    ::close(handle);
    return error;
  }
  return std::unique_ptr<BridgeUdp>(new BridgeUdp(handle, bound));
}

BridgeUdp::~BridgeUdp() { ::close(socket_); }

std::size_t BridgeUdp::receive(std::span<std::byte> into, std::uint16_t& from_port) noexcept {
  sockaddr_in from{};
  socklen_t size = sizeof from;
  ssize_t got = -1;
  do {  // a refusal by a port that was closed is an error of one send, not of this socket
    got = ::recvfrom(socket_, into.data(), into.size(), MSG_TRUNC, std::bit_cast<sockaddr*>(&from),
                     &size);
  } while (got < 0 && (errno == EINTR || errno == ECONNREFUSED));
  from_port = ntohs(from.sin_port);
  if (got < 0) return 0;
  // An empty datagram, and one from 127.0.0.2, are none of ours; as a byte they count as malformed.
  const bool is_ours = got > 0 && from.sin_addr.s_addr == htonl(INADDR_LOOPBACK);
  return is_ours ? static_cast<std::size_t>(got) : 1;
}

void BridgeUdp::send(std::span<const std::byte> datagram, std::uint16_t to_port) noexcept {
  const sockaddr_in address = loopback(to_port);
  // Lost datagrams are part of the protocol: the next one is newer.
  static_cast<void>(::sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT,
                             std::bit_cast<const sockaddr*>(&address), sizeof address));
}

bool BridgeUdp::wait(double seconds) noexcept {
  pollfd polled{socket_, POLLIN, 0};
  return ::poll(&polled, 1, static_cast<int>(std::ceil(1e3 * seconds))) > 0;
}

}  // namespace argil::haptics
