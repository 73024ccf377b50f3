// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab --guide: a path on clay in every kind of guidance, its replay, and what is refused.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/haptics/servo/recording.h"

#include "cli/run_argil.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A gentle bow over the slab's top, whose y is 15.
std::string bow() {
  std::string text;
  for (int x = -12; x <= 12; x += 2) {
    text += std::to_string(x) + " 15 " + std::to_string(5.0 * std::cos(0.13 * x)) + "\n";
  }
  return text;
}

json guided(const std::filesystem::path& path, const std::string& kind,
            std::vector<std::string> more = {}) {
  std::vector<std::string> words{"lab", "clay", "--guide", kind, "--path", path.string(), "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

TEST(LabGuided, DrawsTheHandToThePathOrPushesItOff) {
  const ScratchFolder scratch;
  const auto path = scratch / "bow.txt";
  fill(path, bow());
  const json direct = guided(path, "direct");
  const json indirect = guided(path, "indirect");
  const json hybrid = guided(path, "hybrid");
  for (const json* run : {&direct, &indirect, &hybrid}) {
    EXPECT_EQ((*run)["verdict"], "quiet") << (*run)["guidance"];
    EXPECT_EQ((*run)["faults"], json::array());
    EXPECT_LT((*run)["guidance"]["given_mj"], 25.0) << "what it may give";
  }
  EXPECT_EQ(direct["guidance"]["kind"], "direct");
  EXPECT_LT(direct["guidance"]["error_mm"], hybrid["guidance"]["error_mm"]);
  EXPECT_LT(hybrid["guidance"]["error_mm"], indirect["guidance"]["error_mm"]);
  EXPECT_GT(direct["guidance"]["worked_mj"], 0.1) << "its hand means to go beside it";
  EXPECT_GT(direct["guidance"]["effort_n"], 0.02);
}

TEST(LabGuided, IsTheSameBitsAgainAndInAReplay) {
  const ScratchFolder scratch;
  const auto path = scratch / "bow.csv";
  fill(path, bow());
  const std::string file = (scratch / "run.csv").string();
  const std::string other = (scratch / "other.csv").string();
  const json run = guided(path, "hybrid", {"-o", file});
  guided(path, "hybrid", {"-o", other});
  EXPECT_EQ(content_of(file), content_of(other));
  const Ended again = run_argil({"lab", "clay", "--device", "replay:" + file, "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  const json replayed = json::parse(again.out);
  EXPECT_EQ(replayed["different_ticks"], 0);
  EXPECT_EQ(replayed["guidance"], run["guidance"]) << "with the path from the recording";
}

TEST(LabGuided, TakesThePathOfAStrokeAndDrawsIt) {
  const ScratchFolder scratch;
  const auto path = scratch / "one.strokes.jsonl";
  fill(path,
       "{\"argil_strokes\":1,\"units\":\"mm\"}\n"
       "{\"tool\":\"carve\",\"shape\":\"ball\",\"radius_mm\":4,"
       "\"poses\":[[0,-8,15,0],[1,8,15,4]]}\n");
  const auto picture = scratch / "run.svg";
  const json run = guided(path, "direct", {"--plot", picture.string()});
  EXPECT_LT(run["guidance"]["error_mm"], 6.0);
  EXPECT_THAT(content_of(picture), HasSubstr("guided: direct"));
}

/// In a scene of the report the path is in the device's frame, and the hand does what it does
/// there: it comes from the middle, so that only a path 20 mm to the right is 20 mm off.
TEST(LabGuided, GuidesInAScenesFrameToo) {
  const ScratchFolder scratch;
  const auto path = scratch / "point.txt";
  fill(path, "20 0 0\n");
  const Ended run = run_argil({"lab", "spring", "--set", "k=0", "--set", "c=0", "--guide", "dha",
                               "--path", path.string(), "--hand", "light", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json found = json::parse(run.out);
  EXPECT_EQ(found["guidance"]["kind"], "direct") << "as the report abbreviates it";
  // A light hand of 100 N/m in the middle meets 60 N/m: it starts 20 mm off, and ends 12.5 off.
  EXPECT_NEAR(found["guidance"]["most_error_mm"], 20.0, 3.0);
  EXPECT_EQ(found["guidance"]["stiffness_n_per_m"], 60.0);
}

/// The energy that is printed is that of the force that acted, by delay and ramps.
TEST(LabGuided, CountsTheEnergyOfWhatActed) {
  const ScratchFolder scratch;
  const auto path = scratch / "point.txt";
  fill(path, "20 0 0\n");
  for (const std::string delay : {"1", "4"}) {
    const std::string file = (scratch / ("run" + delay + ".csv")).string();
    const Ended run =
        run_argil({"lab", "spring", "--set", "k=0", "--set", "c=0", "--guide", "direct", "--path",
                   path.string(), "--delay", delay, "-o", file, "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    // Nothing else is felt there, so that the recorded force is the guide's.
    const auto recording = haptics::read_recording(file);
    ASSERT_TRUE(recording.ok()) << recording.error().message;
    const auto& ticks = recording.value().ticks;
    const auto late = static_cast<std::size_t>(std::stoi(delay));
    double given_mj = 0.0;
    double worked_mj = 0.0;
    for (std::size_t n = late + 1; n < ticks.size(); ++n) {
      const double mj =
          dot(ticks[n - 1 - late].force_n, ticks[n].position_mm - ticks[n - 1].position_mm);
      given_mj += mj;
      worked_mj += std::max(0.0, -mj);
    }
    const json found = json::parse(run.out)["guidance"];
    EXPECT_NEAR(found["given_mj"], given_mj, 1e-3) << delay;
    EXPECT_NEAR(found["worked_mj"], worked_mj, 1e-3) << delay;
    EXPECT_GT(std::min(given_mj, worked_mj), 2.0) << "there is something to count";
  }
}

/// Stiffer than rate, delay and filter allow: what is used instead is said.
TEST(LabGuided, SaysHowStiffItReallyIs) {
  const ScratchFolder scratch;
  const auto path = scratch / "line.txt";
  fill(path, "-10 0 0\n10 0 0\n");
  const std::vector<std::string> words{
      "lab",   "spring",         "--set",   "k=0",    "--set",  "c=0",         "--hand",
      "light", "--frictionless", "--guide", "direct", "--path", path.string(), "--guide-stiffness",
      "500",   "--guide-force",  "8"};
  const std::vector<std::vector<std::string>> loops{{"--filter", "0.02", "--filter-lambda", "10"},
                                                    {"--rate", "100", "--delay", "3"},
                                                    {"--rate", "200", "--delay", "5"}};
  for (const auto& loop : loops) {
    std::vector<std::string> all = words;
    all.insert(all.end(), loop.begin(), loop.end());
    const Ended run = run_argil(all);
    EXPECT_THAT(run.out, HasSubstr("spring: quiet")) << loop[0];
    EXPECT_THAT(run.out, HasSubstr("N/m and not 500")) << loop[0];
  }
  EXPECT_THAT(run_argil(words).out, Not(HasSubstr("and not 500")));
}

/// A path along the rim of the slab, from which a hand slides off.
TEST(LabGuided, SaysThatContactWasLost) {
  const ScratchFolder scratch;
  const auto rim = scratch / "rim.txt";
  fill(rim, "-15 15 29.5\n15 15 29.5\n");
  const Ended off = run_argil({"lab", "clay", "--guide", "direct", "--path", rim.string()});
  EXPECT_THAT(off.out, HasSubstr("contact was lost"));
  const auto path = scratch / "bow.txt";
  fill(path, bow());
  EXPECT_FALSE(guided(path, "direct")["contact_lost"]);
}

/// Somebody changed what a recording says of its run.
TEST(LabGuidedBadInput, ReplaysOnlyWhatARunCanHave) {
  const ScratchFolder scratch;
  const auto path = scratch / "line.txt";
  fill(path, "-10 0 0\n10 0 0\n");
  const std::string file = (scratch / "run.csv").string();
  ASSERT_EQ(run_argil({"lab", "spring", "--guide", "direct", "--path", path.string(), "--seconds",
                       "1", "-o", file})
                .status,
            1);
  const std::string text = content_of(file);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    const std::string other = (scratch / "changed.csv").string();
    fill(other, changed);
    const Ended run = run_argil({"lab", "spring", "--device", "replay:" + other});
    EXPECT_EQ(run.status, 3) << to;
    EXPECT_THAT(run.err, HasSubstr("changed.csv"));
    return run.err;
  };
  EXPECT_THAT(refusal("\"rate_hz\":1000.0", "\"rate_hz\":9.0"),
              HasSubstr("--rate is 9; must be 50 to 4000"));
  EXPECT_THAT(refusal("\"delay_ticks\":1", "\"delay_ticks\":99"), HasSubstr("--delay is 99"));
  EXPECT_THAT(refusal("\"hand\":2", "\"hand\":7"), HasSubstr("--hand is 7; must be 0 to 3"));
  EXPECT_THAT(refusal("\"filter_lambda_mm\":0.3", "\"filter_lambda_mm\":-1"),
              HasSubstr("--filter-lambda is -1"));
  EXPECT_THAT(refusal("\"mix_ramp_s\":0.1", "\"mix_ramp_s\":7"), HasSubstr("--mix-ramp is 7"));
  EXPECT_THAT(refusal("\"mix_passive\":[1.0", "\"mix_passive\":[0.2"),
              HasSubstr("CONTACT of --mix-passive"));
  EXPECT_THAT(refusal("\"stiffness_n_per_m\":60.0", "\"stiffness_n_per_m\":900"),
              HasSubstr("stiffness is 900 N/m"));
}

TEST(LabGuidedBadInput, IsRefusedByName) {
  const ScratchFolder scratch;
  const std::string path = (scratch / "bow.txt").string();
  fill(path, bow());
  const std::string junk = (scratch / "junk.csv").string();
  fill(junk, "1 2 3\nhello\n");
  const std::string high = (scratch / "high.csv").string();
  fill(high, "0 15 0\n5 25 0\n");
  const std::string large = (scratch / "large.csv").string();
  const std::string project = (scratch / "large.vdb").string();
  fill(scratch / "large.jsonl",
       "{\"argil_strokes\":1,\"units\":\"mm\",\"start\":{\"shape\":\"block\","
       "\"size_mm\":[200,30,60],\"voxel_mm\":2}}\n");
  ASSERT_EQ(
      run_argil({"sculpt", "--strokes", (scratch / "large.jsonl").string(), "-o", project}).status,
      0);
  fill(large, "-80 15 0\n80 15 0\n");
  struct Case {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases{
      {{"--guide", "firmly", "--path", path}, 2, "--guide is 'firmly'"},
      {{"--guide", "direct"}, 2, "--guide needs --path FILE"},
      {{"--path", path}, 2, "--path needs --guide direct, indirect or hybrid"},
      {{"--path", path, "--guide", "none"}, 2, "--path needs --guide"},
      {{"--guide-stiffness", "90"}, 2, "--guide-stiffness needs --guide"},
      {{"--guidance-force", "1"}, 2, "--guide-force needs --guide"},
      {{"--guide", "direct", "--path", "nowhere.csv"}, 3, "nowhere.csv"},
      {{"--guide", "direct", "--path", path + ".png"}, 2, "--path is"},
      {{"--guide", "direct", "--path", junk}, 3, "junk.csv' line 2"},
      {{"--guide", "direct", "--path", high}, 3, "point 2 of the path, (5, 25, 0) mm"},
      {{"--guide", "direct", "--path", large, "--project", project}, 3, "farther than a Falcon"},
      {{"--guide", "direct", "--path", path, "--guide-stiffness", "900"}, 2, "500"},
      {{"--guide", "direct", "--path", path, "--guide-force", "0"}, 2, "--guide-force"},
  };
  for (const Case& each : cases) {
    std::vector<std::string> words{"lab", "clay"};
    words.insert(words.end(), each.words.begin(), each.words.end());
    const Ended run = run_argil(words);
    EXPECT_EQ(run.status, each.status) << each.says << ": " << run.err;
    EXPECT_THAT(run.err, HasSubstr(each.says));
    if (each.status == 2) {
      EXPECT_THAT(run.err, HasSubstr("argil lab --help")) << each.says;
    }
  }
}

}  // namespace
}  // namespace argil::test
