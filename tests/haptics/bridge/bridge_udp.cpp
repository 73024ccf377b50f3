// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_udp.h"

#include <array>
#include <bit>
#include <cstdio>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace argil::haptics {
namespace {

TEST(BridgeUdp, CarriesDatagramsBothWays) {
  auto one = BridgeUdp::open(0);
  auto two = BridgeUdp::open(0);
  ASSERT_TRUE(one && two);
  const std::array<std::byte, 3> sent{std::byte{1}, std::byte{2}, std::byte{3}};
  one.value()->send(sent, two.value()->address());
  ASSERT_TRUE(two.value()->wait(1.0));
  std::array<std::byte, 2> got{};
  BridgeAddress from;
  EXPECT_EQ(two.value()->receive(got, from), 3U) << "the whole length, though it did not fit";
  EXPECT_EQ(from, one.value()->address());
  EXPECT_EQ(got[1], std::byte{2});
  EXPECT_EQ(two.value()->receive(got, from), 0U);
  EXPECT_FALSE(two.value()->wait(0.0));
}

/// Another address of this machine may have the very port of the simulator.
TEST(BridgeUdp, TakesNothingFromAnotherAddress) {
  auto bridge = BridgeUdp::open(0);
  ASSERT_TRUE(bridge.ok());
  const int other = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  ASSERT_EQ(::bind(other, std::bit_cast<sockaddr*>(&address), sizeof address), 0);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(bridge.value()->port());
  const std::array<std::byte, 40> sent{};
  ASSERT_EQ(::sendto(other, sent.data(), sent.size(), 0, std::bit_cast<sockaddr*>(&address),
                     sizeof address),
            40);
  ::close(other);
  ASSERT_TRUE(bridge.value()->wait(1.0));
  std::array<std::byte, 64> got{};
  BridgeAddress from;
  EXPECT_EQ(bridge.value()->receive(got, from), 1U) << "a byte, which is no message";
}

TEST(BridgeUdp, OutlivesAPortThatIsClosed) {
  auto one = BridgeUdp::open(0);
  ASSERT_TRUE(one.ok());
  BridgeAddress gone;
  {
    auto two = BridgeUdp::open(0);
    ASSERT_TRUE(two.ok());
    gone = two.value()->address();
  }
  const std::array<std::byte, 1> sent{};
  std::array<std::byte, 2> got{};
  BridgeAddress from;
  for (int n = 0; n < 3; ++n) {
    one.value()->send(sent, gone);
    EXPECT_EQ(one.value()->receive(got, from), 0U);
  }
}

TEST(BridgeUdp, SaysWhoHasThePort) {
  auto one = BridgeUdp::open(0);
  ASSERT_TRUE(one.ok());
  const auto two = BridgeUdp::open(one.value()->port());
  ASSERT_FALSE(two.ok());
  EXPECT_EQ(two.error().kind, ErrorKind::device);
  EXPECT_NE(two.error().message.find("--port"), std::string::npos) << two.error().message;
}

/// The addresses that this machine's kernel has UDP sockets of that port at, as it prints them.
std::string addresses_of(std::uint16_t port) {
  char wanted[8];
  std::snprintf(wanted, sizeof wanted, ":%04X", port);
  std::string found;
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream stream(table);
    for (std::string line; std::getline(stream, line);) {
      const std::size_t at = line.find(wanted);
      if (at != std::string::npos && at < 45) found += line.substr(at - 8, 8) + " ";
    }
  }
  return found;
}

TEST(BridgeUdp, ListensOnLoopbackOnly) {
  auto one = BridgeUdp::open(0);
  ASSERT_TRUE(one.ok());
  const std::string loopback =
      std::endian::native == std::endian::little ? "0100007F " : "7F000001 ";
  EXPECT_EQ(addresses_of(one.value()->port()), loopback);
}

}  // namespace
}  // namespace argil::haptics
