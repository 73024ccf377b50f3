// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <netinet/in.h>

#include "argil/core/result.h"

namespace argil::haptics {

/// 127.0.0.1, the only address that the bridge binds to.
sockaddr_in loopback(std::uint16_t port) noexcept;

/// Binds a socket there. The port that it has then; 0: refused, errno says why.
std::uint16_t bind_to_loopback(int socket, std::uint16_t port) noexcept;

/// Of errno.
Error cannot_listen(std::uint16_t port);

}  // namespace argil::haptics
