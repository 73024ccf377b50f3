// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab clay --vibro: detail that is too fine for the tool's force, as a vibration.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/haptics/servo/recording.h"
#include "argil/io/project_file.h"

#include "cli/run_argil.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using nlohmann::json;

/// A slab whose top is wavy along x: 0.1 mm high, 2 mm long, on voxels of 0.25 mm. A ball of 4 mm
/// reads windows of 1 mm, which know nothing of that. The phase keeps the waves from vanishing at
/// the nodes of coarse levels.
std::string rough_slab(const ScratchFolder& scratch) {
  ClayOptions options;
  options.voxel_mm = 0.25;
  const auto distance = [](const Vec3& p) {
    const double waves = 0.1 * std::sin(std::numbers::pi * (p.x - 0.37));
    return std::max({std::abs(p.x) - 20.0, std::abs(p.z) - 16.0, -8.0 - p.y, p.y - 8.0 - waves});
  };
  const Clay clay =
      Clay::from_distance(distance, {{-21.0, -9.0, -17.0}, {21.0, 9.0, 17.0}}, options).value();
  const std::string file = (scratch / "rough.vdb").string();
  EXPECT_TRUE(io::save_project(file, clay).ok());
  return file;
}

json feel_clay(std::vector<std::string> words) {
  words.insert(words.begin(), {"lab", "clay"});
  words.emplace_back("--json");
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

/// How rough a run's force is while the hand slides, N rms: second differences over half the 250 ms
/// in which it passes a wave, of which a vibration in that time is four times its height.
double roughness_n(const std::string& recording) {
  const auto read = haptics::read_recording(recording);
  EXPECT_TRUE(read.ok());
  const auto& ticks = read.value().ticks;
  constexpr std::size_t kApart = 125;
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = kApart; n + kApart < ticks.size(); ++n) {
    if (ticks[n].time_s < 1.7 || ticks[n].time_s > 3.3) continue;
    const Vec3 bend =
        ticks[n + kApart].force_n + ticks[n - kApart].force_n - 2.0 * ticks[n].force_n;
    sum += dot(bend, bend);
    ++count;
  }
  EXPECT_GT(count, 1000);
  return std::sqrt(sum / count);
}

TEST(LabVibro, IsFeltOnRoughClayAndNotOnSmooth) {
  const ScratchFolder scratch;
  const std::string rough = rough_slab(scratch);
  const std::string file = (scratch / "run.csv").string();
  const auto felt = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-o", file});
    feel_clay(words);
    return roughness_n(file);
  };
  const double with = felt({"--project", rough, "--vibro"});
  const double without = felt({"--project", rough});
  const double smooth_with = felt({"--vibro"});
  const double smooth_without = felt({});
  EXPECT_GT(with, without + 0.02);
  EXPECT_NEAR(smooth_with, smooth_without, 0.005);
  RecordProperty("with_mn", std::to_string(1e3 * with));
  RecordProperty("without_mn", std::to_string(1e3 * without));
  RecordProperty("smooth_with_mn", std::to_string(1e3 * smooth_with));
  RecordProperty("smooth_without_mn", std::to_string(1e3 * smooth_without));
}

/// The slab's own waves, which docs/equations.md shows; and that there is nothing without them.
TEST(LabVibro, SaysWhatItAdded) {
  EXPECT_GT(feel_clay({"--vibro", "--set", "A=0.1"})["clay"]["texture_n"], 0.02);
  EXPECT_LT(feel_clay({"--vibro"})["clay"]["texture_n"], 0.002);
  EXPECT_FALSE(feel_clay({})["clay"].contains("texture_n"));
  EXPECT_NE(run_argil({"lab", "clay", "--vibro"}).out.find("--vibro added nothing"),
            std::string::npos);
  const Ended both = run_argil({"lab", "clay", "--set", "A=0.1", "--project", "x.vdb"});
  EXPECT_EQ(both.status, 3);
  EXPECT_NE(both.err.find("--project"), std::string::npos);
}

TEST(LabVibro, LeavesEveryHandQuiet) {
  const ScratchFolder scratch;
  const std::string rough = rough_slab(scratch);
  int turn = 0;
  for (const char* hand : {"push", "light", "arm", "firm"}) {
    for (const auto& [rate, delay] : {std::pair{"1000", "1"}, {"500", "2"}}) {
      const bool is_usual = turn == 0 || turn == 7;  // push at 1000, firm at 500
      ++turn;
      if (!effort(is_usual, true)) continue;
      const json found = feel_clay(
          {"--project", rough, "--vibro", "--hand", hand, "--rate", rate, "--delay", delay});
      EXPECT_EQ(found["verdict"], "quiet") << hand << " " << rate;
      EXPECT_EQ(found["faults"], json::array()) << hand << " " << rate;
    }
  }
}

TEST(LabVibro, ReplaysToTheSameBits) {
  const ScratchFolder scratch;
  const std::string rough = rough_slab(scratch);
  const std::string file = (scratch / "run.csv").string();
  feel_clay({"--project", rough, "--vibro", "-o", file});
  EXPECT_EQ(feel_clay({"--device", "replay:" + file})["different_ticks"], 0);
}

}  // namespace
}  // namespace argil::test
