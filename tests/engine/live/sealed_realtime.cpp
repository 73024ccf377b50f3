// SPDX-License-Identifier: GPL-3.0-or-later
// Strangers at the bridge on the servo's thread. Here because the counters replace malloc for a
// whole program.
#include <algorithm>
#include <array>
#include <thread>

#include <gtest/gtest.h>

#include "argil/haptics/bridge/bridge_session.h"
#include "argil/haptics/bridge/sealed_link.h"

#include "support/realtime_counters.h"

namespace argil {
namespace {

using haptics::BridgeKey;
using haptics::BridgeSender;

/// A datagram with its tag.
struct Sealed {
  std::array<std::byte, haptics::SealedLink::kMostBytes> bytes{};
  std::size_t size = 0;
};

/// Keeps what is sent.
class Keeper final : public haptics::BridgeLink {
 public:
  std::size_t receive(std::span<std::byte>, haptics::BridgeAddress&) noexcept override { return 0; }
  void send(std::span<const std::byte> datagram, const haptics::BridgeAddress&) noexcept override {
    last.size = datagram.size();
    std::ranges::copy(datagram, last.bytes.begin());
  }
  bool wait(double) noexcept override { return false; }
  Sealed last;
};

constexpr haptics::BridgeAddress kFrom{haptics::kLoopbackHost, 7};

/// As somebody says it who has that key.
Sealed sealed_hello(const BridgeKey& key) {
  Keeper keeper;
  haptics::SealedLink(keeper, key, BridgeSender::simulator, kFrom.port)
      .send(haptics::encode(haptics::BridgeHello{{1, 0, 0}, 60.0}).span(), {});
  return keeper.last;
}

/// There is always one more: of another key, said before, or of no length.
class Flood final : public haptics::BridgeLink {
 public:
  Flood(const BridgeKey& key, const BridgeKey& other)
      : heard_(sealed_hello(key)), forged_(sealed_hello(other)) {}
  std::size_t receive(std::span<std::byte> into, haptics::BridgeAddress& from) noexcept override {
    from = kFrom;
    const Sealed& said = ++sent % 3 == 0 ? heard_ : forged_;
    const std::size_t size = sent % 5 == 0 ? into.size() + 1 : said.size;
    std::copy_n(said.bytes.begin(), std::min(said.size, into.size()), into.begin());
    return size;
  }
  void send(std::span<const std::byte>, const haptics::BridgeAddress&) noexcept override {}
  bool wait(double) noexcept override { return true; }
  std::uint64_t sent = 0;

 private:
  Sealed heard_;
  Sealed forged_;
};

TEST(SealedLinkRealtime, DropsAFloodWithoutHeapLockOrSystemCall) {
  constexpr std::uint64_t kTicks = 2000;
  const BridgeKey key = BridgeKey::random();
  Flood flood(key, BridgeKey::random());
  haptics::SealedLink link(flood, key, BridgeSender::bridge, 99);
  haptics::BridgeSession session(link, {});
  test::RealtimeCounts counts;
  bool is_counting = false;
  std::thread([&] {
    is_counting = test::start_counting_this_thread();
    if (!is_counting) return;
    for (std::uint64_t n = 1; n <= kTicks; ++n) session.receive(1e-3 * static_cast<double>(n));
    counts = test::counts_of_this_thread();
  }).join();
  if (!is_counting) GTEST_SKIP() << "the kernel has no seccomp filters";
  EXPECT_EQ(flood.sent, kTicks * haptics::BridgeSession::kMostReceived);
  EXPECT_EQ(link.counts().forged + link.counts().replayed, flood.sent - 1) << "one was the first";
  EXPECT_EQ(session.counts().malformed, 0U) << "nothing of it was read";
  EXPECT_EQ(counts.heap, 0);
  EXPECT_EQ(counts.locks, 0);
  EXPECT_EQ(counts.system_calls, 0);
}

}  // namespace
}  // namespace argil
