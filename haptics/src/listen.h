// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <netinet/in.h>

#include "argil/core/result.h"
#include "argil/haptics/bridge_link.h"

namespace argil::haptics {

/// As the system's calls want it.
sockaddr_in socket_address(const BridgeAddress& address) noexcept;

/// Binds a socket there; port 0: any that is free. The port that it has then; 0: refused, errno
/// says why.
std::uint16_t bind_to(int socket, const BridgeAddress& address) noexcept;

/// Of errno.
Error cannot_listen(const BridgeAddress& address);

}  // namespace argil::haptics
