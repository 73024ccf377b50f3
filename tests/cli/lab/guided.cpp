// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab --guide: a path on clay in every kind of guidance, its replay, and what is refused.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_argil.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
/// there.
TEST(LabGuided, GuidesInAScenesFrameToo) {
  const ScratchFolder scratch;
  const auto path = scratch / "point.txt";
  fill(path, "20 0 0\n");
  const Ended run =
      run_argil({"lab", "workspace", "--guide", "dha", "--path", path.string(), "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json found = json::parse(run.out)["guidance"];
  EXPECT_EQ(found["kind"], "direct") << "as the report abbreviates it";
  EXPECT_GT(found["most_error_mm"], 50.0);
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
      {{"--guide", "direct"}, 3, "--path FILE"},
      {{"--path", path}, 3, "--guide direct, indirect or hybrid"},
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
  }
}

}  // namespace
}  // namespace argil::test
