// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/ftdi_framing.h"

#include <algorithm>
#include <cassert>

namespace argil::haptics {
namespace {

constexpr std::uint8_t kClearToSend = 0x10;
constexpr std::uint8_t kLineErrors = 0x02 | 0x04 | 0x08;

}  // namespace

std::size_t strip_ftdi_status(std::span<std::uint8_t> transfer, FtdiStatus& status) noexcept {
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin + kFtdiStatusBytes <= transfer.size();
       begin += kFtdiPacketBytes) {
    const auto packet =
        transfer.subspan(begin, std::min(kFtdiPacketBytes, transfer.size() - begin));
    status.is_clear_to_send = (packet[0] & kClearToSend) != 0;
    status.has_line_error = status.has_line_error || (packet[1] & kLineErrors) != 0;
    const auto payload = packet.subspan(kFtdiStatusBytes);
    std::copy(payload.begin(), payload.end(), transfer.subspan(kept).begin());
    kept += payload.size();
    assert(kept + kFtdiStatusBytes <= transfer.size());
  }
  return kept;
}

}  // namespace argil::haptics
