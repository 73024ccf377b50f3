// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/listen.h"

#include <bit>
#include <cerrno>
#include <string>
#include <system_error>

#include <arpa/inet.h>
#include <sys/socket.h>

namespace argil::haptics {

sockaddr_in socket_address(const BridgeAddress& address) noexcept {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(address.port);
  out.sin_addr.s_addr = htonl(address.host);
  return out;
}

std::uint16_t bind_to(int socket, const BridgeAddress& address) noexcept {
  sockaddr_in wanted = socket_address(address);
  auto* const name = std::bit_cast<sockaddr*>(&wanted);
  socklen_t size = sizeof wanted;
  if (::bind(socket, name, size) != 0 || ::getsockname(socket, name, &size) != 0) return 0;
  return ntohs(wanted.sin_port);
}

std::string host_text(std::uint32_t host) {
  const in_addr address{htonl(host)};
  char text[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &address, text, sizeof text);
  return text;
}

std::optional<std::uint32_t> host_of(const std::string& text) {
  in_addr address{};
  if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

Error cannot_listen(const BridgeAddress& address) {
  return {ErrorKind::device, "cannot listen on " + host_text(address.host) + " port " +
                                 std::to_string(address.port) + " (" +
                                 std::generic_category().message(errno) +
                                 "); end what listens there or choose another --port or --listen"};
}

}  // namespace argil::haptics
