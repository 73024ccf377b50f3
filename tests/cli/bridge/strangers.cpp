// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge beside programs that have not its key, or say again what somebody said who has it.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/bridge/bridge_udp.h"
#include "argil/haptics/bridge/sealed_link.h"

#include "cli/bridge/clients.h"
#include "cli/run_argil.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using haptics::BridgeAddress;
using haptics::BridgeKey;
using haptics::BridgeLink;
using haptics::BridgeMessage;
using haptics::BridgeProxy;
using haptics::BridgeSender;
using haptics::BridgeUdp;
using haptics::SealedLink;
using testing::HasSubstr;

/// Sends by UDP and remembers what it sent, tags and all.
class Remembered final : public BridgeLink {
 public:
  Remembered() : udp_(BridgeUdp::open(0)) {}
  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override {
    return udp_.value()->receive(into, from);
  }
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override {
    {
      const std::lock_guard lock(mutex_);
      if (sent_.size() < 5) sent_.emplace_back(datagram.begin(), datagram.end());
    }
    udp_.value()->send(datagram, to);
  }
  bool wait(double seconds) noexcept override { return udp_.value()->wait(seconds); }
  std::uint16_t port() const { return udp_.value()->port(); }

  /// What it sent, once more, as by somebody who has got its port.
  void repeat(const BridgeAddress& to) {
    for (const auto& datagram : sent()) udp_.value()->send(datagram, to);
  }

  std::vector<std::vector<std::byte>> sent() const {
    const std::lock_guard lock(mutex_);
    return sent_;
  }

 private:
  Result<std::unique_ptr<BridgeUdp>> udp_;
  mutable std::mutex mutex_;
  std::vector<std::vector<std::byte>> sent_;
};

/// A floor at y = 0 that has the key.
void simulate_floor(Remembered& wire, const BridgeAddress& bridge, const std::stop_token& stop) {
  std::optional<SealedLink> link;
  std::uint64_t sequence = 0;
  bool is_welcome = false;
  while (!stop.stop_requested()) {
    const auto key = link ? std::nullopt : key_of_bridge(std::to_string(bridge.port));
    if (key) link.emplace(wire, *key, BridgeSender::simulator, wire.port());
    if (link && !is_welcome) {
      link->send(encode(haptics::BridgeHello{{++sequence, 0, 0}, 100.0}).span(), bridge);
    }
    std::array<std::byte, haptics::kBridgeMostBytes> bytes;
    BridgeAddress from;
    std::optional<haptics::BridgeState> newest;
    while (const std::size_t size = link ? link->receive(bytes, from) : 0) {
      if (size == BridgeLink::kDropped) continue;
      const auto message = haptics::decode(std::span<const std::byte>(bytes).first(size));
      if (!message) continue;
      is_welcome = true;
      if (const auto* state = std::get_if<haptics::BridgeState>(&*message)) newest = *state;
    }
    if (newest) {
      BridgeProxy proxy;
      proxy.header = {++sequence, 0, haptics::kBridgePlane};
      proxy.echo_sequence = newest->header.sequence;
      proxy.echo_time_ns = newest->header.time_ns;
      proxy.distance_mm = newest->position_mm.y;
      link->send(encode(proxy).span(), bridge);
    }
    wire.repeat(bridge);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// What a stranger would say to be felt, to let the hand go, or to take the simulator's place.
std::vector<BridgeMessage> harmful(std::uint64_t sequence) {
  BridgeProxy wall;
  wall.header = {sequence, 0, haptics::kBridgePlane | haptics::kBridgeContact};
  wall.plane_point_mm = {0.0, 50.0, 0.0};
  wall.distance_mm = -50.0;
  BridgeProxy stop = wall;
  stop.header.flags |= haptics::kBridgeStop;
  return {haptics::BridgeHello{{sequence, 0, 0}, 100.0}, wall, stop,
          haptics::BridgeBye{{sequence, 0, 0}, haptics::BridgeReason::ends}};
}

/// Ten thousand datagrams a second: without a tag, with that of another key, and from another port
/// what the simulator sent.
void meddle(const Remembered& overheard, const BridgeAddress& bridge, const std::stop_token& stop) {
  auto udp = BridgeUdp::open(0);
  auto other = BridgeUdp::open(0);
  SealedLink guessed(*other.value(), BridgeKey::random(), BridgeSender::simulator,
                     other.value()->port());
  std::uint64_t sequence = std::uint64_t{1} << 62U;
  while (!stop.stop_requested()) {
    for (const BridgeMessage& message : harmful(++sequence)) {
      udp.value()->send(encode(message).span(), bridge);
      guessed.send(encode(message).span(), bridge);
    }
    const auto heard = overheard.sent();
    if (!heard.empty()) udp.value()->send(heard[sequence % heard.size()], bridge);
    std::this_thread::sleep_for(std::chrono::microseconds(900));
  }
}

TEST(BridgeStrangers, AreCountedAndNotFelt) {
  const ScratchFolder folder;
  const BridgeAddress bridge{haptics::kLoopbackHost,
                             static_cast<std::uint16_t>(std::stoi(free_port()))};
  const fs::path log = folder / "run.csv";
  Remembered wire;
  const std::jthread floor(
      [&](const std::stop_token& stop) { simulate_floor(wire, bridge, stop); });
  const std::jthread stranger([&](const std::stop_token& stop) { meddle(wire, bridge, stop); });
  const Ended run = run_argil({"bridge", "--port", std::to_string(bridge.port), "--wait", "30",
                               "--seconds", effort("3", "60"), "--log", log.string(), "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto report = run.json();
  const auto& dropped = report["dropped"];
  // How late ticks are is the machine's: that strangers cost one no more than a bounded share, and
  // that without heap, lock or system call, SealedLink.* and SealedLinkRealtime.* hold.
  std::printf("forged %s, replayed %s, late ticks %s of %s\n", dropped["forged"].dump().c_str(),
              dropped["replayed"].dump().c_str(), report["late_ticks"].dump().c_str(),
              report["ticks"].dump().c_str());
  EXPECT_GT(dropped["forged"], 1000);
  EXPECT_GT(dropped["replayed"], 100);
  EXPECT_EQ(dropped["malformed"], 0) << "nothing of it was looked at";
  EXPECT_EQ(dropped["strangers"], 0);
  EXPECT_EQ(report["sessions"], 1);
  const Log rows = read_log(log);
  double most_n = 0.0;
  int stops = 0;
  for (std::size_t n = 0; n < rows.at("tick").size(); ++n) {
    EXPECT_EQ(rows.at("plane_y_mm")[n], 0.0) << "the simulator's, not another's, at tick " << n;
    stops += rows.at("stop")[n] != 0.0 ? 1 : 0;
    most_n = std::max(most_n, rows.at("force_y_n")[n]);
  }
  EXPECT_EQ(stops, 0);
  EXPECT_GT(most_n, 2.0) << "the floor was felt";
}

TEST(BridgeStrangers, AreNeverWelcome) {
  const Remembered nothing;
  const BridgeAddress bridge{haptics::kLoopbackHost,
                             static_cast<std::uint16_t>(std::stoi(free_port()))};
  const std::jthread stranger([&](const std::stop_token& stop) { meddle(nothing, bridge, stop); });
  const Ended run = run_argil({"bridge", "--port", std::to_string(bridge.port), "--wait", "1"});
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, HasSubstr("no simulator was welcomed"));
  EXPECT_THAT(run.err, HasSubstr("its key"));
}

TEST(BridgeStrangers, MayListenOnlyWhereItWasTold) {
  const Ended wrong = run_argil({"bridge", "--listen", "everywhere"});
  EXPECT_EQ(wrong.status, 2);
  const std::string port = free_port();
  const Ended open = run_argil({"bridge", "--port", port, "--listen", "0.0.0.0", "--wait", "0.2"});
  EXPECT_EQ(open.status, 4);
  EXPECT_THAT(open.err, HasSubstr("every machine that reaches it"));
  const Ended closed = run_argil({"bridge", "--port", port, "--wait", "0.2"});
  EXPECT_THAT(closed.err, testing::Not(HasSubstr("every machine")));
}

TEST(BridgeStrangers, CannotPutTheirKeyInItsPlace) {
  const ScratchFolder folder;
  const fs::path key = folder / "bridge.key";
  fill(key, "not a key");
  const Ended run = run_argil({"bridge", "--port", free_port(), "--key", key.string()});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("is no key"));
  EXPECT_EQ(content_of(key), "not a key");
}

}  // namespace
}  // namespace argil::test
