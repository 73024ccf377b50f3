// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <netinet/in.h>

#include "argil/core/result.h"
#include "argil/haptics/bridge/bridge_link.h"

namespace argil::haptics {

/// The address as the system's calls take it.
sockaddr_in socket_address(const BridgeAddress& address) noexcept;

/// Binds a socket; port 0: any that is free. Returns the port that it got, or 0 when it was
/// refused, with errno set.
std::uint16_t bind_to(int socket, const BridgeAddress& address) noexcept;

/// The error of a refusal, from errno.
Error cannot_listen(const BridgeAddress& address);

}  // namespace argil::haptics
