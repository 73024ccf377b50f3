// SPDX-License-Identifier: GPL-3.0-or-later
// How argil bridge ends, by a simulator within the test.
#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/bridge/bridge_message.h"
#include "argil/haptics/bridge/bridge_udp.h"
#include "argil/haptics/bridge/sealed_link.h"

#include "cli/bridge/clients.h"
#include "cli/run_argil.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using haptics::BridgeLink;
using haptics::BridgeUdp;
using haptics::SealedLink;
using testing::HasSubstr;

/// A simulator that greets until it is welcomed, and then takes what it is told.
class Greeter {
 public:
  Greeter() : udp_(BridgeUdp::open(0)), bridge_{haptics::kLoopbackHost, free_number()} {}

  std::uint16_t bridge() const { return bridge_.port; }

  /// The next message of this kind that has arrived.
  template <class Message>
  std::optional<Message> next() {
    std::array<std::byte, haptics::kBridgeMostBytes> bytes;
    haptics::BridgeAddress from;
    while (const std::size_t size = link_ ? link_->receive(bytes, from) : 0) {
      if (size == BridgeLink::kDropped) continue;
      const auto message = haptics::decode(std::span<const std::byte>(bytes).first(size));
      if (message && std::holds_alternative<Message>(*message)) return std::get<Message>(*message);
    }
    return std::nullopt;
  }
  bool is_welcome() {
    if (!link_) {
      if (const auto key = key_of_bridge(std::to_string(bridge_.port))) {
        link_.emplace(*udp_.value(), *key, haptics::BridgeSender::simulator, udp_.value()->port());
      }
    }
    if (!is_welcome_) say(haptics::BridgeHello{{++sequence_, 0, 0}, 60.0});
    is_welcome_ = is_welcome_ || next<haptics::BridgeWelcome>().has_value();
    return is_welcome_;
  }
  void say(const haptics::BridgeMessage& message) {
    if (link_) link_->send(encode(message).span(), bridge_);
  }

 private:
  static std::uint16_t free_number() { return static_cast<std::uint16_t>(std::stoi(free_port())); }
  Result<std::unique_ptr<BridgeUdp>> udp_;
  haptics::BridgeAddress bridge_;
  std::optional<SealedLink> link_;  ///< once the bridge has made its key
  std::uint64_t sequence_ = 0;
  bool is_welcome_ = false;
};

std::vector<std::string> bridge_of(const Greeter& simulator, std::vector<std::string> more) {
  std::vector<std::string> words{"bridge", "--port", std::to_string(simulator.bridge()), "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(BridgeEnds, ByCtrlCWhileItWaitsInLockstep) {
  Greeter simulator;
  RunOptions options;
  options.interrupt_when = [&] {
    return simulator.is_welcome() && simulator.next<haptics::BridgeState>().has_value();
  };
  const Ended run = run_argil(bridge_of(simulator, {"--lockstep"}), options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(run.json()["error"]["kind"], "interrupted");
}

/// Runs it with a simulator beside it, which greets and then does `each` about every STATE.
Ended run_beside(
    const std::vector<std::string>& more,
    const std::function<void(Greeter&)>& each = [](Greeter&) {}) {
  Greeter simulator;
  const std::vector<std::string> words = bridge_of(simulator, more);
  const std::jthread beside([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (simulator.is_welcome() && simulator.next<haptics::BridgeState>()) each(simulator);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  return run_argil(words);
}

TEST(BridgeEnds, AsAFailureWhenASimulatorInLockstepLeftWithoutAnAnswer) {
  const Ended mute = run_beside({"--lockstep"}, [](Greeter& simulator) {
    simulator.say(haptics::BridgeBye{{1'000, 0, 0}, {}});
  });
  EXPECT_EQ(mute.status, 4);
  EXPECT_THAT(mute.err, HasSubstr("without an answer"));
}

/// Being told to end is the usual end of a run in real time, by a person or a service manager.
TEST(BridgeEnds, WithItsLogWhenItIsToldTo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ScratchFolder folder;
    Greeter simulator;
    RunOptions told;
    told.signal = signal;
    told.interrupt_when = [&] {
      return simulator.is_welcome() && simulator.next<haptics::BridgeState>().has_value();
    };
    const auto log = folder / "run.csv";
    const Ended run = run_argil(bridge_of(simulator, {"--log", log.string()}), told);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read_log(log).at("tick").size(), run.json()["ticks"].get<std::size_t>());
    EXPECT_THAT(folder.names(), testing::ElementsAre("run.csv"));
  }
}

TEST(BridgeEnds, AtOnceWhereItsLogCannotBe) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "taken.csv");
  const Ended run = run_beside({"--seconds", "600", "--log", (folder / "taken.csv").string()});
  EXPECT_NE(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("taken.csv"));
}

TEST(BridgeEnds, WithAPlotWhoseNameHasAQuote) {
  ARGIL_CLIENT_OR_SKIP("gnuplot");
  const ScratchFolder folder;
  const auto plot = folder / "the hand's.svg";
  fill(folder / "the hand's.svg.gp", "somebody's own");
  const Ended run = run_beside({"--seconds", "0.5", "--plot", plot.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_GT(std::filesystem::file_size(plot), 1000U);
  EXPECT_EQ(content_of(folder / "the hand's.svg.gp"), "somebody's own");
  EXPECT_EQ(folder.names().size(), 2U);
}

TEST(BridgeEnds, BeforeItBeginsOnWhatCannotBe) {
  const ScratchFolder folder;
  const auto path = folder / "path.csv";
  fill(path, "0, 0, 0\n10, 0, 0\n");
  const Ended unused = run_argil({"bridge", "--path", path.string()});
  EXPECT_EQ(unused.status, 2);
  EXPECT_THAT(unused.err, HasSubstr("--guide direct"));
  EXPECT_EQ(run_argil({"bridge", "--stiffness", "1e7", "--force"}).status, 2);
  const auto empty = folder / "empty.csv";
  fill(empty, "# nothing\n");
  const Ended nothing = run_argil({"bridge", "--guidance", "dha", "--path", empty.string()});
  EXPECT_EQ(nothing.status, 3);
  EXPECT_THAT(nothing.err, HasSubstr("is empty"));
  const Ended blanks =
      run_argil({"bridge", "--guidance", "dha", "--path", path.string(), "--wait", "0.1"});
  EXPECT_EQ(blanks.status, 4) << "blanks are no fault: " << blanks.err;
}

}  // namespace
}  // namespace argil::test
