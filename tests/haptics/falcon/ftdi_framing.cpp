// SPDX-License-Identifier: GPL-3.0-or-later
#include "falcon/ftdi_framing.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

using FalconBytes = std::vector<std::uint8_t>;

/// A transfer as the chip makes it.
FalconBytes framed(const std::string& payload, std::uint8_t modem = 0x01,
                   std::uint8_t line = 0x60) {
  FalconBytes transfer;
  for (std::size_t at = 0; at == 0 || at < payload.size(); at += kFtdiPayloadBytes) {
    transfer.push_back(modem);
    transfer.push_back(line);
    const std::string part = payload.substr(at, kFtdiPayloadBytes);
    transfer.insert(transfer.end(), part.begin(), part.end());
  }
  return transfer;
}

std::string strip(FalconBytes transfer, FtdiStatus& status) {
  const std::size_t kept = strip_ftdi_status(transfer, status);
  return {transfer.begin(), transfer.begin() + static_cast<std::ptrdiff_t>(kept)};
}

TEST(FtdiFraming, TakesTheStatusOutOfEveryPacketOfATransfer) {
  FtdiStatus status;
  std::string payload;
  for (int n = 0; n <= 300; ++n) {
    EXPECT_EQ(strip(framed(payload), status), payload) << n;
    payload += static_cast<char>(n);
  }
}

TEST(FtdiFraming, AnIdleChipSaysNothing) {
  FtdiStatus status;
  EXPECT_EQ(strip({0x01, 0x60}, status), "");
  EXPECT_FALSE(status.is_clear_to_send);
  EXPECT_FALSE(status.has_line_error);
  EXPECT_EQ(strip({0x11, 0x60}, status), "");
  EXPECT_TRUE(status.is_clear_to_send);
}

TEST(FtdiFraming, KeepsTheLastStatusOfAnEmptyTransfer) {
  FtdiStatus status{true, true};
  EXPECT_EQ(strip({}, status), "");
  EXPECT_EQ(strip({0x01}, status), "");
  EXPECT_TRUE(status.is_clear_to_send && status.has_line_error);
}

TEST(FtdiFraming, SeesALineErrorInAnyPacket) {
  for (const int error : {0x62, 0x64, 0x68}) {
    FalconBytes transfer = framed(std::string(100, 'x'));
    transfer[1] = static_cast<std::uint8_t>(error);
    FtdiStatus status;
    strip(transfer, status);
    EXPECT_TRUE(status.has_line_error);
  }
}

TEST(FtdiFraming, ReadsNothingBeyondAnyCut) {
  const FalconBytes whole = framed(std::string(150, 'x'));
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const FalconBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    FtdiStatus status;
    EXPECT_LE(strip(cut, status).size(), size);
  }
}

}  // namespace
}  // namespace argil::haptics
