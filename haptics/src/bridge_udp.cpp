// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge_udp.h"

#include <bit>
#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace argil::haptics {
namespace {

sockaddr_in loopback(std::uint16_t port) noexcept {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

Error refused(std::uint16_t port) {
  return {ErrorKind::device, "cannot listen on 127.0.0.1 port " + std::to_string(port) + " (" +
                                 std::generic_category().message(errno) +
                                 "); end what listens there or choose another --port"};
}

}  // namespace

Result<std::unique_ptr<BridgeUdp>> BridgeUdp::open(std::uint16_t port) {
  const int handle = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (handle < 0) return refused(port);
  sockaddr_in address = loopback(port);
  auto* const name = std::bit_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(handle, name, size) != 0 || ::getsockname(handle, name, &size) != 0) {
    const Error error = refused(port);
    ::close(handle);
    return error;
  }
  return std::unique_ptr<BridgeUdp>(new BridgeUdp(handle, ntohs(address.sin_port)));
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
