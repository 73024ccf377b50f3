// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab: every scene with every hand, recordings and replays, and what it refuses.
#include <algorithm>
#include <array>
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

constexpr std::array kHands{"push", "light", "arm", "firm"};
constexpr std::array kRigid{
    "spring",        "free",       "wall-rigid",   "wall-linear",      "wall-nonlinear",
    "sphere",        "cylinder",   "pebbles",      "sine-z",           "sine-normal",
    "sine-gradient", "sine-table", "sine-nearest", "sine-differences", "sine-network",
    "slider",        "click",      "workspace"};

json lab(std::vector<std::string> words) {
  words.insert(words.begin(), "lab");
  words.emplace_back("--json");
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

/// The scenes and hands that are not quiet: of all of them, usually of each scene with one hand, by
/// turns.
std::vector<std::string> restless(const std::vector<std::string>& more) {
  std::vector<std::string> found;
  for (std::size_t n = 0; n < kRigid.size(); ++n) {
    for (std::size_t h = 0; h < kHands.size(); ++h) {
      // Among them the rigid wall in the push hand, the one that the governor is needed for.
      const bool is_usual = (n + n / kHands.size() + 2) % kHands.size() == h;
      if (!effort(is_usual, true)) continue;
      std::vector<std::string> words{kRigid[n], "--hand", kHands[h]};
      words.insert(words.end(), more.begin(), more.end());
      if (lab(words)["verdict"] != "quiet") {
        found.push_back(std::string(kRigid[n]) + " " + kHands[h]);
      }
    }
  }
  return found;
}

/// Changes what a recording says of its run.
void change_note(const std::string& file, const std::string& from, const std::string& to) {
  std::string text = content_of(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  std::ofstream(file) << text;
}

TEST(LabDefaults, AreQuietAtOneKilohertzWithATickOfDelay) {
  EXPECT_THAT(restless({"--rate", "1000", "--delay", "1"}), testing::IsEmpty());
}

TEST(LabDefaults, AreQuietAt500HertzWithTwoTicksOfDelay) {
  EXPECT_THAT(restless({"--rate", "500", "--delay", "2"}), testing::IsEmpty());
}

TEST(LabDefaults, AreNotQuietThereWithoutTheGovernor) {
  EXPECT_THAT(restless({"--rate", "500", "--delay", "2", "--no-governor"}),
              testing::Not(testing::IsEmpty()));
}

/// Usually the least damped hand at the one rate and the most damped at the other, each for less
/// time.
TEST(LabDefaults, AreQuietOnClay) {
  int turn = 0;
  for (const char* hand : kHands) {
    for (const auto& [rate, delay] : {std::pair{"1000", "1"}, {"500", "2"}}) {
      const bool is_usual = turn == 0 || turn == 7;  // push at 1000, firm at 500
      ++turn;
      if (!effort(is_usual, true)) continue;
      std::vector<std::string> words{"clay", "--hand", hand, "--rate", rate, "--delay", delay};
      if (effort(true, false)) words.insert(words.end(), {"--seconds", "5"});
      const json found = lab(words);
      EXPECT_EQ(found["verdict"], "quiet") << hand << " " << rate;
      EXPECT_EQ(found["faults"], json::array()) << hand << " " << rate;
    }
  }
}

TEST(Lab, CyclesOnARigidWallWhenCoupledDirectly) {
  for (const char* hand : kHands) {
    const json found = lab({"wall-rigid", "--hand", hand, "--coupling", "direct"});
    EXPECT_EQ(found["verdict"], "limit_cycle") << hand;
    EXPECT_GT(found["work_mw"], 2.0) << hand;
  }
}

TEST(Lab, MeasuresTheReleasedHandle) {
  const json found = lab({"free", "--coupling", "direct", "--frictionless"})["handle"];
  EXPECT_NEAR(found["damping_ratio"], 0.0724, 0.0015);
  EXPECT_NEAR(found["mass_kg"], 0.4589, 0.006);
  EXPECT_NEAR(found["damping_n_s_per_m"], 3.975, 0.08);
  const json printed =
      lab({"free", "--coupling", "direct", "--frictionless", "--as-printed"})["handle"];
  EXPECT_NEAR(printed["damping_n_s_per_m"], 2.775, 0.08);
}

/// Section 3.1: the report's handle reached -50 to 50, -70 to 80 and -70 to 80 mm.
TEST(Lab, MeasuresTheWorkspace) {
  const json reach = lab({"workspace", "--coupling", "direct"})["reach_mm"];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LT(reach["min"][axis], -45.0) << axis;
    EXPECT_GT(reach["min"][axis], -110.0) << axis;
    EXPECT_GT(reach["max"][axis], 45.0) << axis;
    EXPECT_LT(reach["max"][axis], 110.0) << axis;
  }
}

TEST(Lab, RepelsTheHandleWithTheCouplingAsPrinted) {
  // eq. 4.2 pushes the handle further in: it ends at the arms' stop
  const json found = lab({"wall-linear", "--as-printed"});
  EXPECT_GT(found["depth_mm"], 40.0);
}

TEST(Lab, ReplaysARecordingToTheSameBits) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  lab({"sine-normal", "--hand", "light", "--rate", "800", "-o", file});
  const json again = lab({"sine-normal", "--device", "replay:" + file});
  EXPECT_EQ(again["different_ticks"], 0);
  EXPECT_GT(again["ticks"], 4000);
}

/// A recording says what was set, so that its replay is of the same scene.
TEST(Lab, ReplaysASceneThatWasSet) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json run = lab({"sphere", "--set", "R=30", "--set", "k=900", "-o", file});
  EXPECT_GT(run["depth_mm"], 2.0);  // 3 N in a spring of 900 N/m and the coupling's
  EXPECT_EQ(lab({"sphere", "--device", "replay:" + file})["different_ticks"], 0);
  change_note(file, "\"k\":900.0", "\"k\":950.0");
  const Ended other = run_argil({"lab", "sphere", "--device", "replay:" + file, "--json"});
  EXPECT_EQ(other.status, 1);
  change_note(file, "\"k\":950.0", "\"k\":1e9");
  const Ended wrong = run_argil({"lab", "sphere", "--device", "replay:" + file});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.err, testing::HasSubstr("k is 1e+09 N/m"));
}

/// Weights, ramp and filter are the run's, and so the replay's.
TEST(Lab, ReplaysTheMixAndTheFilterThatWereChosen) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json run =
      lab({"clay", "--active", "--mix-passive", "0.7,0.1", "--mix-active", "0.2,1.5", "--mix-ramp",
           "0.3", "--filter", "0.3", "--filter-lambda", "0.5", "--seconds", "5", "-o", file});
  EXPECT_NEAR(run["most_stiffness_n_per_m"], 0.5 * 3.0 / (1.5e-3 + 7e-3 / 3.0), 1.0);
  EXPECT_EQ(lab({"clay", "--device", "replay:" + file})["different_ticks"], 0);
  const std::string kept = content_of(file);
  for (const auto& [from, to] : {std::pair{"\"mix_passive\":[0.7,", "\"mix_passive\":[0.8,"},
                                 {"\"mix_active\":[0.2,", "\"mix_active\":[0.1,"},
                                 {"\"mix_ramp_s\":0.3", "\"mix_ramp_s\":0.2"},
                                 {"\"filter_gain\":0.3", "\"filter_gain\":0.4"}}) {
    std::ofstream(file) << kept;
    change_note(file, from, to);
    EXPECT_EQ(run_argil({"lab", "clay", "--device", "replay:" + file, "--json"}).status, 1) << to;
  }
  std::ofstream(file) << kept;
  change_note(file, "\"mix_ramp_s\":0.3", "\"mix_ramp_s\":3.0");
  const Ended wrong = run_argil({"lab", "clay", "--device", "replay:" + file});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.err, testing::HasSubstr("--mix-ramp is 3; must be 0 to 2"));
}

/// In every tick of a run the tool, whose place is recorded, is where eq. 6 to 8 allow.
TEST(Lab, KeepsAFilteredToolNearTheHandle) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  lab({"workspace", "--coupling", "direct", "--filter", "0.1", "--filter-lambda", "2", "-o", file});
  const auto recording = haptics::read_recording(file);
  ASSERT_TRUE(recording.ok());
  double widest_mm = 0.0;
  for (const haptics::ServoTick& tick : recording.value().ticks) {
    widest_mm = std::max(widest_mm, length(tick.proxy_mm - tick.position_mm));
  }
  EXPECT_LE(widest_mm, 0.9 * 2.0);
  EXPECT_GT(widest_mm, 0.5) << "it filters";
}

/// A wall that cycles with fixed damping and the same one with adaptive; the replay is of what ran.
TEST(Lab, DampsWhatCycles) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const std::vector<std::string> wall{"wall-linear", "--set",      "k=3000", "--set",
                                      "c=0",         "--coupling", "direct", "--hand",
                                      "push",        "-o",         file,     "--damping"};
  const auto with = [&](const char* damping) {
    std::vector<std::string> words = wall;
    words.emplace_back(damping);
    words.emplace_back("--frictionless");
    return lab(words);
  };
  const json fixed = with("fixed");
  EXPECT_EQ(fixed["verdict"], "limit_cycle");
  EXPECT_FALSE(fixed.contains("added_damping_n_s_per_m"));
  const json adaptive = with("adaptive");
  EXPECT_NE(adaptive["verdict"], "limit_cycle");
  EXPECT_GT(adaptive["added_damping_n_s_per_m"]["most"], 5.0);
  EXPECT_EQ(lab({"wall-linear", "--device", "replay:" + file})["different_ticks"], 0);
  change_note(file, "\"damping\":1", "\"damping\":0");
  EXPECT_EQ(run_argil({"lab", "wall-linear", "--device", "replay:" + file}).status, 1);
}

/// The spring's frequency is that of its k and the handle's mass.
TEST(Lab, MeasuresTheHandleInASpringThatWasSet) {
  for (const char* k : {"k=400", "k=1200"}) {
    const json found =
        lab({"free", "--coupling", "direct", "--frictionless", "--set", k})["handle"];
    EXPECT_NEAR(found["mass_kg"], 0.4589, 0.01) << k;
  }
}

TEST(Lab, SaysWhenASettingAsksForMoreThanTheGateGives) {
  const json run = lab({"wall-rigid", "--coupling", "direct", "--set", "F=60", "--seconds", "5"});
  EXPECT_THAT(run["faults"].dump(), testing::HasSubstr("limit"));
}

TEST(Lab, ListsBeforeAnythingElse) {
  const Ended run = run_argil({"lab", "--list", "trial", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(json::parse(run.out).contains("scenes"));
}

/// Walls as stiff as docs/stability.md speaks of.
TEST(Lab, TakesAWallThatCyclesAndCalmsItByAdaptiveDamping) {
  const std::vector<std::string> words{"wall-linear", "--set",  "k=8000", "--set", "c=0",
                                       "--coupling",  "direct", "--hand", "push"};
  EXPECT_EQ(lab(words)["verdict"], "limit_cycle");
  std::vector<std::string> adaptive = words;
  adaptive.insert(adaptive.end(), {"--damping", "adaptive"});
  EXPECT_EQ(lab(adaptive)["verdict"], "quiet");
  for (const char* hand : {"push", "light", "arm", "firm"}) {
    EXPECT_EQ(lab({"wall-linear", "--set", "k=40000", "--hand", hand})["verdict"], "quiet") << hand;
  }
}

/// On the ball, where it is as hard as the report has it.
TEST(Lab, HoldsOnTheClicksBall) {
  const auto verdict = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"click", "--hand", "push", "--frictionless"});
    return lab(words)["verdict"];
  };
  EXPECT_EQ(verdict({"--coupling", "direct"}), "limit_cycle");
  EXPECT_EQ(verdict({}), "quiet");
}

TEST(Lab, ListsWhatCanBeSet) {
  const json list = lab({"--list"})["scenes"];
  ASSERT_EQ(list.size(), kRigid.size() + 1);
  for (std::size_t n = 0; n < kRigid.size(); ++n) {
    EXPECT_EQ(list[n]["name"], kRigid[n]);
    ASSERT_GT(list[n]["parameters"].size(), 0U) << kRigid[n];
    EXPECT_NE(list[n]["parameters"][0]["equation"], "") << kRigid[n];
    for (const json& parameter : list[n]["parameters"]) {
      const std::string set =
          parameter["name"].get<std::string>() + "=" + parameter["usual"].dump();
      EXPECT_EQ(run_argil({"lab", kRigid[n], "--set", set, "--seconds", "1", "--json"}).status, 1)
          << "too short to judge, " << kRigid[n] << " " << set;
      if (!effort(false, true)) break;
    }
  }
}

TEST(Lab, ReplaysTheClayItCarved) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json run = lab({"clay", "--active", "--tool", "ball:6", "--law", "blanch", "--exponent",
                        "3", "--seconds", "5", "-o", file});
  const json again = lab({"clay", "--device", "replay:" + file});
  EXPECT_EQ(again["different_ticks"], 0);
  EXPECT_GT(run["clay"]["carved_mm3"], 1.0);
  EXPECT_EQ(again["clay"]["hash"], run["clay"]["hash"]);
}

TEST(Lab, ReplaysTheClayOfARealTimeRun) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json run = lab({"clay", "--active", "--real-time", "--seconds", "5", "-o", file});
  ASSERT_EQ(run["dropped_ticks"], 0);
  ASSERT_EQ(run["clay"]["dropped_samples"], 0);
  const json again = lab({"clay", "--device", "replay:" + file});
  EXPECT_EQ(again["different_ticks"], 0);
}

/// What a delay gives the hand is seen in a recording too: each force goes with the way on which
/// the device held it, not with the way at its tick.
TEST(Lab, JudgesAReplayAsTheRunWasJudged) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json run = lab({"wall-rigid", "--coupling", "direct", "--hand", "push", "--no-governor",
                        "--delay", "4", "-o", file});
  const json again = lab({"wall-rigid", "--device", "replay:" + file});
  EXPECT_EQ(run["verdict"], "limit_cycle");
  EXPECT_EQ(again["verdict"], "limit_cycle");
  EXPECT_NEAR(again["work_mw"].get<double>() / run["work_mw"].get<double>(), 1.0, 0.02);
  EXPECT_NEAR(again["position_pp_mm"].get<double>() / run["position_pp_mm"].get<double>(), 1.0,
              0.02);
}

TEST(Lab, SaysWhenAReplayDiffers) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  lab({"wall-linear", "-o", file});
  change_note(file, "\"coupling_stiffness_n_per_m\":1500.0",
              "\"coupling_stiffness_n_per_m\":700.0");
  const Ended run = run_argil({"lab", "wall-linear", "--device", "replay:" + file, "--json"});
  EXPECT_EQ(run.status, 1);
  EXPECT_GT(json::parse(run.out)["different_ticks"], 0);
}

TEST(LabBadInput, OfARecordingsNoteIsRefused) {
  const ScratchFolder scratch;
  const std::string kept = (scratch / "kept.csv").string();
  const std::string file = (scratch / "run.csv").string();
  lab({"wall-linear", "-o", kept});
  const std::pair<const char*, const char*> changes[] = {{"\"law\":0", "\"law\":7"},
                                                         {"\"rate_hz\":1000.0", "\"rate_hz\":1e-9"},
                                                         {"\"hand\":2", "\"hand\":4"},
                                                         {"\"damping\":0", "\"damping\":2"},
                                                         {"\"exponent\":2.0", "\"exponent\":0.0"},
                                                         {"\"seconds\":0.0", "\"seconds\":1e9"},
                                                         {"_mm\":0.3", "_mm\":1e308"},
                                                         {"_per_m\":1500.0", "_per_m\":1e308"},
                                                         {"\"skin_mm\":8.0", "\"skin_mm\":1e308"},
                                                         {"_mm\":[4.0,", "_mm\":[1e308,"},
                                                         {"_mm\":[4.0,", "_mm\":[-4.0,"}};
  for (const auto& [from, to] : changes) {
    std::filesystem::copy_file(kept, file, std::filesystem::copy_options::overwrite_existing);
    change_note(file, from, to);
    const Ended run = run_argil({"lab", "wall-linear", "--device", "replay:" + file});
    EXPECT_EQ(run.status, 3) << to;
    EXPECT_THAT(run.err, testing::HasSubstr("; must be ")) << to;  // name, value and range
  }
}

TEST(Lab, SavesTheClayItWorked) {
  const ScratchFolder scratch;
  const std::string first = (scratch / "carved.vdb").string();
  const json run = lab({"clay", "--active", "--seconds", "5", "--save", first});
  const Ended info = run_argil({"info", first, "--json"});
  EXPECT_EQ(json::parse(info.out)["hash"], run["clay"]["hash"]);
}

TEST(Lab, SaysWhenARunIsTooShortToJudge) {
  const Ended run = run_argil({"lab", "clay", "--seconds", "1", "--json"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(json::parse(run.out)["verdict"], "unfinished");
  const Ended words = run_argil({"lab", "wall-linear", "--seconds", "1"});
  EXPECT_EQ(words.status, 1) << words.err;
  EXPECT_THAT(words.out, testing::HasSubstr("unfinished"));
  EXPECT_THAT(words.out, testing::HasSubstr("give it --seconds 2 or more"));
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  EXPECT_EQ(run_argil({"lab", "wall-linear", "--seconds", "1", "-o", file}).status, 1);
  const Ended again = run_argil({"lab", "wall-linear", "--device", "replay:" + file});
  EXPECT_EQ(again.status, 1) << again.err;
  EXPECT_THAT(again.out, testing::HasSubstr("record it with --seconds 2 or more"));
  // Of one that a person held nobody knows a plan.
  change_note(file, "\"device\":\"sim\"", "\"device\":\"falcon\"");
  EXPECT_EQ(run_argil({"lab", "wall-linear", "--device", "replay:" + file}).status, 0);
  EXPECT_EQ(run_argil({"lab", "wall-linear", "--seconds", "2"}).status, 0);
}

/// On virtual time the clay is asked every 10 ms, told where the tool is every 5 ms, and answers a
/// tool that rests every 50. A replay says what the recording does.
TEST(Lab, SaysHowOldTheClayIsThatIsFelt) {
  const ScratchFolder scratch;
  const std::string file = (scratch / "run.csv").string();
  const json age = lab({"clay", "--seconds", "5", "-o", file})["clay"]["age_ms"];
  EXPECT_GT(age["p50"], 1.0);
  EXPECT_LE(age["p50"], 30.0);
  EXPECT_LE(age["max"], 100.0);
  EXPECT_GE(age["p99"], age["p50"]);
  EXPECT_GE(age["max"], age["p99"]);
  const json again = lab({"clay", "--device", "replay:" + file})["clay"]["age_ms"];
  EXPECT_EQ(again, age);
}

TEST(Lab, DrawsTheRun) {
  const ScratchFolder scratch;
  for (const char* scene : {"wall-linear", "free", "sphere", "clay"}) {
    const std::string file = (scratch / (std::string(scene) + ".svg")).string();
    const bool is_dear = std::string(scene) == "clay";
    const bool slides = is_dear || std::string(scene) == "sphere";
    const Ended run =
        run_argil({"lab", scene, "--plot", file, "--seconds", is_dear ? effort("1", "3") : "3"});
    EXPECT_EQ(run.status, slides ? 1 : 0) << scene << run.err;  // 1: too short to judge
    EXPECT_GT(std::filesystem::file_size(file), 5'000U) << scene;
  }
}

TEST(LabBadInput, IsRefusedByName) {
  const ScratchFolder scratch;
  const std::string junk = (scratch / "junk.csv").string();
  std::ofstream(junk) << "hello\n";
  const std::string wall = (scratch / "wall.csv").string();
  lab({"wall-linear", "-o", wall});
  struct Case {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases{
      {{"lab"}, 2, "SCENE"},
      {{"lab", "well"}, 2, "'well'; must be one of spring, free"},
      {{"lab", "sphere", "--device", "falcon9"}, 2, "--device is 'falcon9'"},
      {{"lab", "sphere", "--device", "replay:"}, 2, "--device is 'replay:'"},
      {{"lab", "sphere", "--damping", "loose"}, 2, "--damping"},
      {{"lab", "sphere", "--damping", ""}, 2, "--damping"},
      {{"lab", "sphere", "--device", "replay:nowhere.csv"}, 3, "nowhere.csv"},
      {{"lab", "sphere", "--device", "replay:" + junk}, 3, "not a recording"},
      {{"lab", "sphere", "--device", "replay:" + wall}, 3, "'wall-linear'"},
      {{"lab", "sphere", "--set", "R"}, 2, "--set is 'R'; must be NAME=NUMBER"},
      {{"lab", "sphere", "--set", "R=wide"}, 2, "--set is 'R=wide'"},
      {{"lab", "sphere", "--set", "R=500"}, 2, "R is 500 mm; must be from 5 to 100 mm"},
      {{"lab", "--set", "R=nan", "sphere"}, 2, "R is nan"},
      {{"lab", "sphere", "--set", "q=5"}, 2, "has no 'q'; what can be set is R, k, c"},
      {{"lab", "clay", "--set", "k=5"}, 2, "what can be set is A, f"},
      {{"lab", "sphere", "--hand", "foot"}, 2, "--hand"},
      {{"lab", "sphere", "--rate", "0"}, 2, "--rate"},
      {{"lab", "sphere", "--delay", "17"}, 2, "--delay"},
      {{"lab", "sphere", "--filter", "1.5"}, 2, "--filter is '1.5'; must be"},
      {{"lab", "sphere", "--seconds", "nan"}, 2, "--seconds"},
      {{"lab", "sphere", "-o", "no/such/folder/run.csv"}, 5, "no/such/folder"},
      {{"lab", "clay", "--tool", "box:1,2,3"}, 3, "ball:R or ellipsoid:A,B,C"},
      {{"lab", "clay", "--project", "nowhere.vdb"}, 3, "nowhere.vdb"},
  };
  for (const Case& one : cases) {
    const Ended run = run_argil(one.words);
    EXPECT_EQ(run.status, one.status) << one.says << ": " << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr(one.says));
  }
}

}  // namespace
}  // namespace argil::test
