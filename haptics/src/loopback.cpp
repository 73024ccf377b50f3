// SPDX-License-Identifier: GPL-3.0-or-later
#include "loopback.h"

#include <bit>
#include <cerrno>
#include <string>
#include <system_error>

#include <arpa/inet.h>
#include <sys/socket.h>

namespace argil::haptics {

sockaddr_in loopback(std::uint16_t port) noexcept {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

std::uint16_t bind_to_loopback(int socket, std::uint16_t port) noexcept {
  sockaddr_in address = loopback(port);
  auto* const name = std::bit_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(socket, name, size) != 0 || ::getsockname(socket, name, &size) != 0) return 0;
  return ntohs(address.sin_port);
}

Error cannot_listen(std::uint16_t port) {
  return {ErrorKind::device, "cannot listen on 127.0.0.1 port " + std::to_string(port) + " (" +
                                 std::generic_category().message(errno) +
                                 "); end what listens there or choose another --port"};
}

}  // namespace argil::haptics
