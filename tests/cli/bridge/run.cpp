// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge with simulators in processes of their own: the Python stand-in, and Blender.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "cli/bridge/clients.h"
#include "cli/run_argil.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A run of the bridge with a simulator that is there already, or comes; `said` is what it says.
json bridged_beside(const fs::path& said, const std::string& port, const Words& more) {
  Words words{"bridge", "--port", port, "--wait", "60", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err << content_of(said);
  return json::parse(run.out, nullptr, false);
}

/// A run of the bridge with one simulator from beginning to end.
json bridged(const Words& simulator, const std::string& port, const Words& more) {
  const ScratchFolder folder;
  Beside beside(simulator, folder / "said");
  json run = bridged_beside(folder / "said", port, more);
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  return run;
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

/// The tool that Blender shows is the one that is felt: near the handle, by eq. 6 to 12.
TEST(BridgeStandInClient, IsToldWhereTheFilterHasTheHandle) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  bridged(stand_in(port), port,
          {"--lockstep", "--stiffness", "600", "--filter", "0.2", "--filter-lambda", "1", "--log",
           file});
  const Log log = read_log(file);
  double widest_mm = 0.0;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    widest_mm = std::max(widest_mm, std::hypot(log.at("felt_x_mm")[n] - log.at("x_mm")[n],
                                               log.at("felt_y_mm")[n] - log.at("y_mm")[n],
                                               log.at("felt_z_mm")[n] - log.at("z_mm")[n]));
  }
  EXPECT_LE(widest_mm, 0.8 * 1.0);
  EXPECT_GT(widest_mm, 0.1) << "it filters";
  const Ended stiff = run_argil({"bridge", "--port", port, "--wait", "3", "--filter", "0.2"});
  EXPECT_EQ(stiff.status, 3);
  EXPECT_NE(stiff.err.find("felt 4 ms late by --filter"), std::string::npos) << stiff.err;
}

/// Two runs of the same thing, or three.
void expect_same_bits(const std::function<Words(const std::string&)>& simulator,
                      const Words& more) {
  const ScratchFolder folder;
  const std::string port = free_port();
  std::vector<std::string> logs(effort(2, 3));
  for (std::string& log : logs) {
    const std::string file = (folder / "run.csv").string();
    Words words = more;
    words.insert(words.end(), {"--log", file});
    bridged(simulator(port), port, words);
    log = content_of(file);
  }
  EXPECT_GT(logs[0].size(), 100'000U);
  EXPECT_TRUE(logs.front() == logs[1] && logs[1] == logs.back());
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
  interrupted.interrupt_when = [&] {
    std::error_code missing;
    const auto bytes = fs::file_size(growing(file), missing);
    return !missing && bytes > 200'000;
  };
  const Ended run = run_argil(
      {"bridge", "--port", port, "--log", file, "--plot", (folder / "run.svg").string(), "--json"},
      interrupted);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_log(file).at("tick").size(), run.json()["ticks"].get<std::size_t>());
  EXPECT_TRUE(fs::exists(folder / "run.svg"));
  EXPECT_EQ(beside.wait(), 0) << "it was told goodbye";
}

/// What a run that goes on has logged so far: whether a force was felt, and again after a silence.
struct Felt {
  bool before = false;
  bool after = false;
  int silent_ticks = 0;
  bool pushes_in_silence = false;
};
Felt felt_in(const fs::path& log_file) {
  const Log log = read_log(log_file);
  Felt felt;
  if (log.count("distance_mm") == 0) return felt;
  for (std::size_t n = 0; n < log.at("distance_mm").size(); ++n) {
    const double force = std::hypot(log.at("force_x_n")[n], log.at("force_y_n")[n]);
    if (log.at("age_s")[n] >= 0.3) {
      ++felt.silent_ticks;
      felt.pushes_in_silence |= force != 0.0;
    } else {
      (felt.silent_ticks == 0 ? felt.before : felt.after) |= force > 1.0;
    }
  }
  return felt;
}

/// Until it is so, at most 40 s: a Blender starts slowly on a machine that is at work.
void await(const std::function<bool()>& is_so) {
  for (int n = 0; n < 400 && !is_so(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

/// Killed in contact, and another one comes: real time, so only what holds however late all is.
void expect_comes_back(const std::function<Words(const std::string&)>& simulator) {
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  std::optional<Beside> first(std::in_place, simulator(port), folder / "said");
  std::optional<Beside> second;
  std::atomic<bool> is_over = false;
  std::thread meddler([&] {
    await([&] { return felt_in(growing(file)).before; });
    first->kill();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    second.emplace(simulator(port), folder / "said");
    await([&] { return felt_in(growing(file)).after; });
    is_over = true;
  });
  RunOptions until_felt_again;
  until_felt_again.interrupt_when = [&] { return is_over.load(); };
  const Ended run = run_argil(
      {"bridge", "--port", port, "--wait", "60", "--seconds", "90", "--log", file, "--json"},
      until_felt_again);
  meddler.join();
  ASSERT_EQ(run.status, 0) << run.err << content_of(folder / "said");
  EXPECT_EQ(run.json()["sessions"], 2) << content_of(folder / "said");
  const Felt felt = felt_in(file);
  EXPECT_TRUE(felt.before && felt.after);
  EXPECT_FALSE(felt.pushes_in_silence);
  EXPECT_GT(felt.silent_ticks, 100);
}

TEST(BridgeStandInClient, IsKilledInContactAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("python3");
  expect_comes_back([](const std::string& port) { return stand_in(port); });
}

TEST(BridgeBlenderClient, HoldsThePressInLockstep) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const std::string port = free_port();
  // One Blender for all at 60 Hz: its start takes longer than a run.
  const ScratchFolder folder;
  const fs::path said = folder / "said";
  Beside beside(blender(port, {}, 3), said);
  expect_holds(bridged_beside(said, port, lockstep("plane")));
  expect_holds(bridged_beside(said, port, lockstep("indirect")));
  expect_chatters(bridged_beside(said, port, lockstep("direct")));
  EXPECT_EQ(beside.wait(), 0) << content_of(said);
  expect_holds(bridged(blender(port, {"--rate", "200"}), port, lockstep("direct")));
}

TEST(BridgeBlenderClient, GivesTheSameBitsEveryTime) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_same_bits([](const std::string& port) { return blender(port); }, lockstep("plane"));
}

TEST(BridgeBlenderClient, IsKilledInContactAndComesBack) {
  ARGIL_CLIENT_OR_SKIP("blender");
  expect_comes_back([](const std::string& port) { return blender(port); });
}

TEST(BridgeBlenderClient, IsFeltThroughTheAddOn) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const std::string port = free_port();
  const json run = bridged({"blender", "-b", "--factory-startup", "--python-exit-code", "3",
                            "--python", "tests/cli/bridge/addon.py", "--", port, "12"},
                           port, {"--seconds", effort("3", "5")});
  EXPECT_GT(run["most_force_n"].get<double>(), 1.0);
  EXPECT_EQ(run["sessions"], 1);
}

/// A hand that goes down before ten cubes and pushes through them, mm of the hand at scale 10.
void write_push(const fs::path& file) {
  std::ofstream(file) << "0,-20,30,0,0\n0.5,-20,30,0,0\n1.5,-20,6,0,0\n5,80,6,0,0\n";
}

Words dynamic(const fs::path& motion, const std::string& seconds, const std::string& log) {
  return {"--lockstep", "--coupling", "indirect",  "--scale",  "10",
          "--hand",     "firm",       "--damping", "3",        "--seconds",
          seconds,      "--log",      log,         "--motion", motion.string()};
}

/// The proxies of the bridge's log are the lines of Blender's own, in their order.
void expect_same_proxies(const Log& log, const Log& seen) {
  std::size_t frame = 0;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    if (log.at("echo_time_s")[n] == (n == 0 ? 0.0 : log.at("echo_time_s")[n - 1])) continue;
    ASSERT_LT(frame, seen.at("frame").size()) << "at tick " << n;
    for (const char* name : {"proxy_x_mm", "proxy_y_mm", "proxy_z_mm", "contact", "distance_mm"}) {
      ASSERT_EQ(seen.at(name)[frame], log.at(name)[n]) << name << " at tick " << n;
    }
    ++frame;
  }
  EXPECT_GT(frame, 300U);
}

TEST(BridgeBlenderClient, PushesTenCubesByTheProxysSpring) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  const std::string seen = (folder / "seen.csv").string();
  write_push(folder / "push.csv");
  bridged(blender(port, {"--scene", "cubes", "--log", seen}), port,
          dynamic(folder / "push.csv", "5.5", file));
  const Log log = read_log(file);
  expect_same_proxies(log, read_log(seen));
  double most_n = 0.0;
  double least_gap_mm = 1e9;
  for (std::size_t n = 1; n < log.at("tick").size(); ++n) {
    if (log.at("share")[n] < 1.0) continue;
    least_gap_mm = std::min(least_gap_mm, log.at("distance_mm")[n]);
    const bool is_held = log.at("echo_time_s")[n] == log.at("echo_time_s")[n - 1];
    if (!is_held || log.at("contact")[n] == 0.0 || log.at("force_x_n")[n] == 0.0) continue;
    // What the servo gave, by where Bullet had the proxy: the slew limit is not reached here.
    const double spring = 1.5 * (log.at("proxy_x_mm")[n] - log.at("x_mm")[n]) +
                          0.003 * (log.at("proxy_vx_mm_per_s")[n] - log.at("vx_mm_per_s")[n]);
    most_n = std::max(most_n, -spring);
    ASSERT_NEAR(log.at("force_x_n")[n], spring, 0.01) << "at " << log.at("time_s")[n];
  }
  EXPECT_GT(most_n, 1.0) << "it pushes";
  // 0.1 mm of the hand, 1 mm of the scene: none is entered (BulletIsTheLawsSpring tells more).
  EXPECT_GT(least_gap_mm, -0.1);
}

ProgramRun blender_test(const Words& words) {
  Words all{"blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python"};
  all.insert(all.end(), words.begin(), words.end());
  return run_program(all);
}

TEST(BridgeBlenderClient, BulletIsTheLawsSpring) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ProgramRun run = blender_test({"tests/cli/bridge/blender_bullet.py", "--", "stiffness",
                                       "no_offset", "hovering", "tunnelling"});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST(BridgeBlenderClient, FeelsAwkwardMeshesAsTheyAre) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ProgramRun run = blender_test({"tests/cli/bridge/blender_surface.py"});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST(BridgeBlenderClient, FollowsTheSceneByTheAddOn) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ProgramRun run =
      blender_test({"tests/cli/bridge/blender_addon_changes.py", "--", free_port()});
  EXPECT_EQ(run.status, 0) << run.output;
}

/// Python that saves a .blend with what `makes` makes of an empty scene.
std::string saving_blend(const fs::path& file, const std::string& makes) {
  return "import bpy\nfor obj in list(bpy.data.objects): bpy.data.objects.remove(obj)\n" + makes +
         "\nbpy.ops.wm.save_as_mainfile(filepath='" + file.string() + "')";
}

void write_blend(const fs::path& file, const std::string& makes) {
  const ProgramRun run = run_program({"blender", "-b", "--factory-startup", "--python-exit-code",
                                      "3", "--python-expr", saving_blend(file, makes)});
  ASSERT_EQ(run.status, 0) << run.output;
}

Words blender_of(const fs::path& file, const std::string& port) {
  Words words = blender(port, {"--scene", "file"});
  words.insert(words.begin() + 3, file.string());
  return words;
}

TEST(BridgeBlenderClient, IsFreeBesideAConesEdgeAndAfterLiftOff) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  // Its flat side up at y = 0, 30 mm of the hand wide, and acute at the rim.
  write_blend(folder / "cone.blend",
              "bpy.ops.mesh.primitive_cone_add(radius1=0.3, depth=0.6, location=(0, 0, -0.3), "
              "rotation=(3.141592653589793, 0, 0))");
  std::ofstream(folder / "path.csv") << "0,35,10,0,0\n1,35,10,-10,0\n2,35,-10,10,0\n"
                                        "2.5,35,10,0,0\n3,0,10,0,0\n3.5,0,-4,0,0\n"
                                        "4,5,-4,0,0\n4.1,5,20,0,0\n5,-35,0.5,0,0\n";
  const json run = bridged(blender_of(folder / "cone.blend", port), port,
                           {"--lockstep", "--scale", "10", "--hand", "firm", "--motion",
                            (folder / "path.csv").string(), "--seconds", "5.5", "--log", file});
  EXPECT_GT(run["most_force_n"].get<double>(), 1.0);
  const Log log = read_log(file);
  int beside = 0;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    const bool is_beside = std::hypot(log.at("x_mm")[n], log.at("z_mm")[n]) > 31.0;
    if (!is_beside && log.at("y_mm")[n] <= 0.0) continue;
    beside += is_beside && log.at("y_mm")[n] < 0.0 ? 1 : 0;
    ASSERT_EQ(std::hypot(log.at("force_x_n")[n], log.at("force_y_n")[n], log.at("force_z_n")[n]),
              0.0)
        << "at " << log.at("time_s")[n];
  }
  EXPECT_GT(beside, 100) << "under the rim's plane";
}

TEST(BridgeBlenderClient, HoversOverBodiesWithoutForceAndLiftsOffFreely) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string file = (folder / "run.csv").string();
  // The proxy's radius is 5 mm of the hand: it hovers 0.3 mm over the floor, presses, lifts off.
  std::ofstream(folder / "path.csv") << "0,-20,30,0,0\n1,-20,5.3,0,0\n2,-40,5.3,0,0\n"
                                        "2.5,-40,2,0,0\n3,-40,2,0,0\n3.1,-40,30,0,0\n";
  bridged(blender(port, {"--scene", "cubes"}), port, dynamic(folder / "path.csv", "3.5", file));
  const Log log = read_log(file);
  double most_n = 0.0;
  for (std::size_t n = 0; n < log.at("tick").size(); ++n) {
    const double force = log.at("force_y_n")[n];
    most_n = std::max(most_n, force);
    ASSERT_GE(force, 0.0) << "drawn in at " << log.at("time_s")[n];
    if (log.at("y_mm")[n] > 5.2) {
      ASSERT_EQ(force, 0.0) << "at " << log.at("time_s")[n];
    }
  }
  EXPECT_GT(most_n, 1.0);
}

/// A Blender that gives up at once says why.
void expect_says(const Words& simulator, const std::string& port, const std::string& why) {
  const ScratchFolder folder;
  Beside beside(simulator, folder / "said");
  RunOptions until_it_gave_up;
  until_it_gave_up.interrupt_when = [&] {
    return content_of(folder / "said").find(", exiting.") != std::string::npos;
  };
  run_argil({"bridge", "--port", port, "--wait", "60", "--seconds", "60"}, until_it_gave_up);
  EXPECT_EQ(WEXITSTATUS(beside.wait()), 3);
  EXPECT_NE(content_of(folder / "said").find(why), std::string::npos)
      << content_of(folder / "said");
}

TEST(BridgeBlenderClient, SaysWhyASceneIsNotFelt) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  // The first Blender also saves what the second opens: its start takes longer than the run.
  Words first = blender(port, {"--scene", "cubes"});
  const auto init = std::find(first.begin(), first.end(), "--python");
  first.insert(init, {"--python-expr", saving_blend(folder / "empty.blend", "")});
  expect_says(first, port, "--coupling indirect");
  expect_says(blender_of(folder / "empty.blend", port), port, "empty.blend' shows no mesh");
}

TEST(BridgeBlenderClient, SaysGoodbyeAndKeepsItsLogWhenItsLoopFails) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string seen = (folder / "seen.csv").string();
  Words words = blender(port, {"--log", seen});
  const auto loop = std::find(words.begin(), words.end(), "examples/blender/BoucleCouplage.py");
  // Between init.py and the loop: a mesh that fails at the hundredth frame.
  words.insert(loop - 1, {"--python-expr",
                          "import argil_session as session\n"
                          "answer = session.contact.answer\n"
                          "session.contact.answer = lambda *said: "
                          "answer(*said) if len(session.rows) < 100 else 1 / 0"});
  Beside beside(words, folder / "said");
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--lockstep"});
  EXPECT_EQ(run.status, 0) << "it was told goodbye: " << run.err;
  EXPECT_EQ(WEXITSTATUS(beside.wait()), 3) << content_of(folder / "said");
  EXPECT_NE(content_of(folder / "said").find("ZeroDivisionError"), std::string::npos);
  EXPECT_EQ(read_log(seen).at("frame").size(), 100U);
}

TEST(BridgeStandInClient, SaysGoodbyeOnCtrlC) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  Words words = stand_in(port);
  words.insert(words.begin(),
               {"timeout", "--foreground", "--preserve-status", "--signal=INT", "2"});
  Beside beside(words, folder / "said");
  const std::string file = (folder / "run.csv").string();
  run_argil({"bridge", "--port", port, "--seconds", "3", "--log", file});
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  EXPECT_EQ(content_of(folder / "said").find("Traceback"), std::string::npos);
  EXPECT_LT(read_log(file).at("age_s").back(), 0.0) << "nobody is there since it said goodbye";
}

TEST(BridgeStandInClient, SaysThatTheBridgeIsBusy) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string port = free_port();
  Beside felt(stand_in(port), folder / "said");
  ProgramRun late;
  std::atomic<bool> is_over = false;
  std::thread meddler([&] {
    await([&] { return felt_in(growing(folder / "run.csv")).before; });
    late = run_program(stand_in(port, {"--seconds", "1"}));
    is_over = true;
  });
  RunOptions until_it_was_told;
  until_it_was_told.interrupt_when = [&] { return is_over.load(); };
  run_argil({"bridge", "--port", port, "--seconds", "60", "--log", (folder / "run.csv").string()},
            until_it_was_told);
  meddler.join();
  EXPECT_EQ(felt.wait(), 0) << content_of(folder / "said");
  EXPECT_NE(late.status, 0);
  EXPECT_NE(late.output.find("busy with another simulator"), std::string::npos) << late.output;
}

TEST(BridgeStandInClient, RefusesRatesThatTheBridgeWouldChop) {
  ARGIL_CLIENT_OR_SKIP("python3");
  for (const char* rate : {"0", "5", "5000", "nan"}) {
    const ProgramRun run = run_program(stand_in(free_port(), {"--rate", rate}));
    EXPECT_NE(run.status, 0);
    EXPECT_NE(run.output.find("not within 10 to 1000 Hz"), std::string::npos) << run.output;
    EXPECT_EQ(run.output.find("Traceback"), std::string::npos) << run.output;
  }
}

TEST(BridgeStandInClient, TakesAKeyThatIsItsUsersAloneAndNoOther) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ProgramRun run = run_program({"python3", "tests/cli/bridge/keys.py"});
  EXPECT_EQ(run.status, 0) << run.output;
}

TEST(BridgeStandInClient, TakesAndRefusesWhatTheCorpusSays) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ProgramRun run = run_program({"python3", "tests/cli/bridge/corpus.py"});
  EXPECT_EQ(run.status, 0) << run.output;
}

}  // namespace
}  // namespace argil::test
