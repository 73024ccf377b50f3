// SPDX-License-Identifier: GPL-3.0-or-later
// argil bridge --scene with simulators in processes of their own: what is felt is the scene, and
// nothing of theirs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/servo/recording.h"

#include "cli/bridge/clients.h"
#include "cli/run_argil.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// The bridge with a scene, and one simulator from beginning to end.
json felt(const Words& simulator, const std::string& port, const Words& more) {
  const ScratchFolder folder;
  Beside beside(simulator, folder / "said");
  Words words{"bridge", "--port", port, "--wait", "60", "--json", "--scene"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err << content_of(folder / "said");
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  EXPECT_THAT(content_of(folder / "said"), HasSubstr("with the law scene"));
  return json::parse(run.out, nullptr, false);
}

/// The log of a scene: what its first line says, and its columns.
struct SceneLog {
  json scene;
  Log columns;
};
SceneLog read_scene_log(const fs::path& file) {
  std::ifstream stream(file);
  std::string first;
  std::getline(stream, first);
  EXPECT_EQ(first.substr(0, 2), "# ");
  const ScratchFolder folder;
  std::ofstream(folder / "rest.csv") << stream.rdbuf();
  return {json::parse(first.substr(2), nullptr, false), read_log(folder / "rest.csv")};
}

const Words kSpring{"spring", "--set", "k=400", "--set", "c=0", "--stiffness", "500", "--lockstep"};

TEST(BridgeSceneStandInClient, FeelsTheSpringAndSaysWhichOne) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string file = (folder / "run.csv").string();
  const std::string port = free_port();
  const json run = felt(stand_in(port), port, with(kSpring, {"--log", file}));
  const json said{{"name", "spring"},
                  {"settings", {{"k", 400.0}, {"c", 0.0}, {"x", 0.0}, {"y", 0.0}, {"z", 0.0}}}};
  EXPECT_EQ(run["law"], "scene");
  EXPECT_EQ(run["scene"], said);
  const SceneLog log = read_scene_log(file);
  EXPECT_EQ(log.scene, said);
  const auto& x_mm = log.columns.at("x_mm");
  const auto& force_n = log.columns.at("force_x_n");
  // Springs in series; the servo has ramped in by then.
  const double felt_n_per_mm = 1e-3 * 400.0 * 500.0 / (400.0 + 500.0);
  for (std::size_t n = 0; n < x_mm.size(); ++n) {
    if (log.columns.at("time_s")[n] < 0.6) continue;
    ASSERT_NEAR(force_n[n], -felt_n_per_mm * x_mm[n], 2e-3) << n;
  }
  EXPECT_GT(std::ranges::max(x_mm), 7.0) << "the hand sweeps as the lab's does";
  EXPECT_LT(std::ranges::min(x_mm), -7.0);
  EXPECT_EQ(std::ranges::max(log.columns.at("contact")), 0.0) << "the simulator claims nothing";
  EXPECT_EQ(std::ranges::max(log.columns.at("plane")), 0.0);
}

TEST(BridgeSceneStandInClient, IsFeltTheSameWhateverTheSimulatorsRate) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string file = (folder / "run.csv").string();
  const std::string port = free_port();
  std::vector<std::string> texts;
  std::vector<Log> logs;
  for (const char* rate : {"60", "60", "200"}) {
    felt(stand_in(port, {"--rate", rate}), port, {"sphere", "--lockstep", "--log", file});
    texts.push_back(content_of(file));
    logs.push_back(read_scene_log(file).columns);
  }
  EXPECT_TRUE(texts[0] == texts[1]) << "the same bits every time";
  EXPECT_FALSE(texts[0] == texts[2]) << "the simulator's side differs";
  for (const char* column : {"x_mm", "y_mm", "z_mm", "force_x_n", "force_y_n", "force_z_n"}) {
    EXPECT_EQ(logs[0].at(column), logs[2].at(column)) << column;
  }
  EXPECT_GT(std::ranges::max(logs[0].at("force_y_n")), 1.0);
}

/// The bridge's servo, coupling and hand are the lab's.
TEST(BridgeSceneStandInClient, GivesTheForcesOfTheLab) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const std::string bridged = (folder / "bridge.csv").string();
  const std::string lab = (folder / "lab.csv").string();
  const std::string port = free_port();
  felt(stand_in(port), port, {"slider", "--set", "f=30", "--lockstep", "--log", bridged});
  ASSERT_EQ(run_argil({"lab", "slider", "--set", "f=30", "-o", lab}).status, 0);
  const auto recording = haptics::read_recording(lab);
  ASSERT_TRUE(recording.ok());
  const auto& ticks = recording.value().ticks;
  const Log log = read_scene_log(bridged).columns;
  const std::size_t count = std::min(ticks.size(), log.at("tick").size());
  ASSERT_GT(count, 5000U);
  for (std::size_t n = 0; n < count; ++n) {
    ASSERT_EQ(log.at("z_mm")[n], ticks[n].position_mm.z) << n;
    ASSERT_EQ(log.at("force_z_n")[n], ticks[n].force_n.z) << n;
  }
}

TEST(BridgeSceneStandInClient, SaysThatASettingAsksForMoreThanTheGateGives) {
  ARGIL_CLIENT_OR_SKIP("python3");
  const ScratchFolder folder;
  const fs::path deep = folder / "deep.csv";
  std::ofstream(deep) << "0,0,0,0,0\n1,0,0,0,0\n2,0,-60,0,0\n";
  const std::string port = free_port();
  const json run = felt(
      stand_in(port), port,
      {"wall-rigid", "--set", "F=60", "--hand", "firm", "--motion", deep.string(), "--lockstep"});
  EXPECT_THAT(run["faults"].dump(), HasSubstr("limit"));
  EXPECT_LE(run["most_force_n"].get<double>(), 8.0 + 1e-9);
}

TEST(BridgeSceneStandInClient, DrawsItsLog) {
  ARGIL_CLIENT_OR_SKIP("python3");
  ARGIL_CLIENT_OR_SKIP("gnuplot");
  const ScratchFolder folder;
  const std::string port = free_port();
  const fs::path picture = folder / "run.svg";
  felt(stand_in(port), port, {"sphere", "--set", "R=30", "--lockstep", "--plot", picture.string()});
  const std::string drawn = content_of(picture);
  EXPECT_THAT(drawn, HasSubstr("scene sphere R=30 k=3000 c=50"));
  EXPECT_THAT(drawn, HasSubstr("<path")) << "there are lines";
}

TEST(BridgeSceneBlenderClient, IsShownByTheScripts) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  const std::string ours = (folder / "run.csv").string();
  const std::string theirs = (folder / "blender.csv").string();
  const json run = felt(blender(port, {"--log", theirs}), port, with(kSpring, {"--log", ours}));
  EXPECT_GT(run["most_force_n"].get<double>(), 1.0);
  const Log seen = read_log(theirs);
  ASSERT_GT(seen.at("frame").size(), 300U);
  EXPECT_EQ(seen.at("proxy_x_mm"), seen.at("x_mm")) << "the proxy is the handle";
  EXPECT_EQ(std::ranges::max(seen.at("contact")), 0.0);
}

TEST(BridgeSceneBlenderClient, IsShownByTheAddOn) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder folder;
  const std::string port = free_port();
  Beside beside({"blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python",
                 "tests/cli/bridge/addon.py", "--", port, "12", "scene"},
                folder / "said");
  const Ended run = run_argil({"bridge", "--port", port, "--wait", "60", "--json", "--scene",
                               "spring", "--seconds", effort("3", "5")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(beside.wait(), 0) << content_of(folder / "said");
  EXPECT_GT(run.json()["most_force_n"].get<double>(), 0.5);
}

TEST(BridgeScene, RefusesWhatCannotBeFelt) {
  struct Case {
    Words words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases{
      {{"--scene", "cube"}, 2, "--scene is 'cube'; must be one of spring, free, wall-rigid"},
      {{"--scene", "clay"}, 2, "must be --clay P.vdb instead"},
      {{"--scene", "sphere", "--set", "R=500"}, 2, "R is 500 mm; must be from 5 to 100 mm"},
      {{"--scene", "sphere", "--set", "q=5"}, 2, "has no 'q'; what can be set is R, k, c"},
      {{"--scene", "sphere", "--set", "R"}, 2, "--set is 'R'; must be NAME=NUMBER"},
      {{"--set", "R=30"}, 2, "--scene"},
      {{"--scene", "sphere", "--clay", "some.vdb"}, 2, "--clay"},
      {{"--scene", "sphere", "--coupling", "plane"}, 2, "--coupling"},
      {{"--scene", "sphere", "--damping", "1"}, 2, "--damping"},
      {{"--scene", "sphere", "--force"}, 2, "--force"},
      {{"--scene", "sphere", "--press", "2"}, 2, "name one of them with --motion"},
      {{"--scene", "sphere", "--stiffness", "5000"}, 3, "must be 50 to 3000 N/m"},
  };
  for (const Case& each : cases) {
    Words words{"bridge", "--port", free_port(), "--wait", "0.2"};
    words.insert(words.end(), each.words.begin(), each.words.end());
    const Ended run = run_argil(words);
    EXPECT_EQ(run.status, each.status) << testing::PrintToString(each.words) << run.err;
    EXPECT_THAT(run.err, HasSubstr(each.says));
  }
}

}  // namespace
}  // namespace argil::test
