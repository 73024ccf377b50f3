// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge with simulators in processes of their own: the Python stand-in, and Blender.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "bridge_clients.h"
#include "run_argil.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A run of the bridge with one simulator from beginning to end.
json bridged(const Words& simulator, const std::string& port, Words more) {
  const ScratchFolder folder;
  Beside beside(simulator, folder / "said");
  Words words{"bridge", "--port", port, "--wait", "60", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err << content_of(folder / "said");
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  return json::parse(run.out, nullptr, false);
}

Words lockstep(const std::string& coupling, Words more = {}) {
  Words words{"--lockstep", "--force",   "--hand", "light",      "--press",
              "4",          "--damping", "3",      "--coupling", coupling};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void expect_holds(const json& run) {
  EXPECT_LT(run["force_deviation_n"].get<double>(), 0.01);
  EXPECT_EQ(run["contact_breaks"], 0);
  EXPECT_LE(run["depth_mm"].get<double>(), 1.2 * 4000.0 / 1500.0);
  EXPECT_GT(run["force_mean_n"][1].get<double>(), 2.0);
}

void expect_chatters(const json& run) {
  EXPECT_GT(run["force_rms_n"].get<double>(), 1.0);
  EXPECT_GT(run["contact_breaks"].get<int>(), 10);
}

TEST(BridgeStandInClient, OnlyDirectChattersAtSixtyHertz) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const std::string port = free_port();
  expect_holds(bridged(stand_in(port), port, lockstep("plane")));
  expect_holds(bridged(stand_in(port), port, lockstep("indirect")));
  expect_chatters(bridged(stand_in(port), port, lockstep("direct")));
  expect_holds(bridged(stand_in(port, {"--rate", "200"}), port, lockstep("direct")));
}

TEST(BridgeStandInClient, SlidesWithoutDragAndIsFreeWithoutForce) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  bridged(stand_in(port), port, {"--lockstep", "--motion", "slide", "--log", file});
  const Log slide = read_log(file);
  for (std::size_t n = 0; n < slide.at("tick").size(); ++n) {
    ASSERT_LE(std::hypot(slide.at("force_x_n")[n], slide.at("force_z_n")[n]), 0.05);
  }
  EXPECT_GT(slide.at("x_mm").back(), 30.0);
  for (const char* law : {"direct", "indirect", "plane"}) {
    const json run =
        bridged(stand_in(port), port, lockstep(law, {"--motion", "free", "--seconds", "2"}));
    EXPECT_EQ(run["most_force_n"], 0.0) << law;
  }
}

/// Three runs of the same thing.
void expect_same_bits(const std::function<Words(const std::string&)>& simulator,
                      const Words& more) {
  const ScratchFolder folder;
  const std::string port = free_port();
  std::array<std::string, 3> logs;
  for (std::string& log : logs) {
    const std::string file = (folder / "run.csv").string();
    Words words = more;
    words.insert(words.end(), {"--log", file});
    bridged(simulator(port), port, words);
    log = content_of(file);
  }
  EXPECT_GT(logs[0].size(), 100'000U);
  EXPECT_TRUE(logs[0] == logs[1] && logs[1] == logs[2]);
}

TEST(BridgeStandInClient, GivesTheSameBitsEveryTime) {
  ARGIL_CLIENT_OR_SKIP("python3");
  expect_same_bits(
      [](const std::string& port) {
        return stand_in(port, {"--shape", "ball"});
      },
      lockstep("plane", {"--motion", "slide"}));
}

TEST(BridgeStandInClient, RefusesARateThatItsStiffnessBreaks) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  Beside beside(stand_in(port), folder / "said");
  const Ended run = run_argil({"bridge", "--port", port, "--coupling", "direct", "--wait", "3"});
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("k T < 2 b"), std::string::npos) << run.err;
  EXPECT_NE(beside.wait(), 0);
  EXPECT_NE(content_of(folder / "said").find("too stiff"), std::string::npos);
}

TEST(BridgeStandInClient, KeepsTheLogOfARunThatCtrlCEnds) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  Beside beside(stand_in(port), folder / "said");
  RunOptions interrupted;
  interrupted.interrupt_after_ms = 4000;
  const Ended run = run_argil(
      {"bridge", "--port", port, "--log", file, "--plot", (folder / "run.svg").string(), "--json"},
      interrupted);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_log(file).at("tick").size(), run.json()["ticks"].get<std::size_t>());
  EXPECT_TRUE(fs::exists(folder / "run.svg"));
  EXPECT_EQ(beside.wait(), 0) << "it was told goodbye";
}

/// Killed in contact, and another one comes: real time, so only what holds however late all is.
void expect_comes_back(const std::function<Words(const std::string&)>& simulator, double live_s) {
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  std::optional<Beside> first(std::in_place, simulator(port), folder / "said");
  std::optional<Beside> second;
  std::thread meddler([&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(live_s));
    first->kill();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    second.emplace(simulator(port), folder / "said");
  });
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--seconds",
                               std::to_string(2.0 * live_s + 2.0), "--log", file, "--json"});
  meddler.join();
  ASSERT_EQ(run.status, 0) << run.err << content_of(folder / "said");
  EXPECT_EQ(run.json()["sessions"], 2) << content_of(folder / "said");
  const Log log = read_log(file);
  int silent = 0;
  bool was_felt = false;
  bool is_felt = false;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    const double force = std::hypot(log.at("force_x_n")[n], log.at("force_y_n")[n]);
    if (log.at("age_s")[n] >= 0.3) {
      ++silent;
      ASSERT_EQ(force, 0.0) << "at " << log.at("time_s")[n];
    } else {
      (silent == 0 ? was_felt : is_felt) |= force > 1.0;
    }
  }
  EXPECT_TRUE(was_felt && is_felt);
  EXPECT_GT(silent, 100);
}

TEST(BridgeStandInClient, IsKilledInContactAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("python3");
  expect_comes_back([](const std::string& port) { return stand_in(port); }, 2.5);
}

TEST(BridgeBlenderClient, HoldsThePressInLockstep) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const std::string port = free_port();
  expect_holds(bridged(blender(port), port, lockstep("plane")));
  expect_holds(bridged(blender(port), port, lockstep("indirect")));
  expect_chatters(bridged(blender(port), port, lockstep("direct")));
  expect_holds(bridged(blender(port, {"--rate", "200"}), port, lockstep("direct")));
}

TEST(BridgeBlenderClient, GivesTheSameBitsEveryTime) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_same_bits([](const std::string& port) { return blender(port); }, lockstep("plane"));
}

TEST(BridgeBlenderClient, IsKilledInContactAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_comes_back([](const std::string& port) { return blender(port); }, 6.0);
}

TEST(BridgeBlenderClient, IsFeltThroughTheAddOn) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const std::string port = free_port();
  const json run = bridged({"blender", "-b", "--factory-startup", "--python-exit-code", "3",
                            "--python", "tests/cli/bridge_addon.py", "--", port, "12"},
                           port, {"--seconds", "5"});
  EXPECT_GT(run["most_force_n"].get<double>(), 1.0);
  EXPECT_EQ(run["sessions"], 1);
}

/// A hand that goes down before ten cubes and pushes through them, mm of the hand at scale 10.
void write_push(const fs::path& file) {
  std::ofstream(file) << "0,-20,30,0,0\n0.5,-20,30,0,0\n1.5,-20,6,0,0\n5,80,6,0,0\n";
}

TEST(BridgeBlenderClient, PushesTenCubesByTheProxysSpring) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  write_push(folder / "push.csv");
  bridged(blender(port, {"--scene", "cubes"}), port,
          {"--lockstep", "--coupling", "indirect", "--scale", "10", "--hand", "firm", "--motion",
           (folder / "push.csv").string(), "--seconds", "5.5", "--log", file});
  const Log log = read_log(file);
  double most_n = 0.0;
  double most_off_n = 0.0;
  double least_gap_mm = 1e9;
  for (std::size_t n = 1; n < log.at("tick").size(); ++n) {
    // What Blender says of its spring is of the state that it answers.
    const bool is_new = log.at("echo_time_s")[n] != log.at("echo_time_s")[n - 1];
    if (!is_new || log.at("share")[n] < 1.0) continue;
    least_gap_mm = std::min(least_gap_mm, log.at("distance_mm")[n]);
    if (log.at("contact")[n] == 0.0) continue;
    const double spring = 1.5 * (log.at("proxy_x_mm")[n] - log.at("x_mm")[n - 1]);
    most_n = std::max(most_n, -log.at("force_x_n")[n]);
    most_off_n = std::max(most_off_n, std::abs(spring - log.at("direct_x_n")[n]));
  }
  EXPECT_GT(most_n, 1.0) << "it pushes";
  EXPECT_LT(most_off_n, 0.01) << "the handle's spring is Blender's";
  // 0.5 mm of the hand, 5 mm of the scene, a twentieth of a cube: none is passed through.
  EXPECT_GT(least_gap_mm, -0.5);
}

}  // namespace
}  // namespace argil::test
