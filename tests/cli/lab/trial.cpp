// SPDX-License-Identifier: GPL-3.0-or-later
// argil lab trial: the study by simulated hands, its order, its table and its analysis.
#include "lab/trial.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_argil.h"
#include "lab/trial_spread.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using namespace cli::lab;
using nlohmann::json;
using testing::HasSubstr;

json trial(std::vector<std::string> words) {
  words.insert(words.begin(), {"lab", "trial"});
  words.emplace_back("--json");
  const Ended run = run_argil(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

/// Usually of all hands.
json row_of(const json& study, const std::string& task, const std::string& condition,
            const std::string& hand = "all") {
  for (const json& row : study["rows"]) {
    if (row["task"] == task && row["condition"] == condition && row["hand"] == hand) return row;
  }
  ADD_FAILURE() << "no row of " << task << ", " << condition << ", " << hand;
  return {};
}

/// The lines of a table, each by its columns' names.
std::vector<std::map<std::string, std::string>> table_of(const std::string& text) {
  const auto parted = [](const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
  };
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  const auto names = parted(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(stream, line)) {
    const auto words = parted(line);
    EXPECT_EQ(words.size(), names.size()) << line;
    std::map<std::string, std::string> row;
    for (std::size_t n = 0; n < std::min(words.size(), names.size()); ++n) row[names[n]] = words[n];
    rows.push_back(row);
  }
  return rows;
}

TEST(LabTrial, GivesTheSameTableForTheSameSeedAndAnotherForAnother) {
  const ScratchFolder scratch;
  const auto table = [&](const char* seed, const char* name) {
    const auto file = scratch / name;
    trial({"--seed", seed, "--repeats", "1", "--hand", "light", "-o", file.string()});
    return content_of(file);
  };
  const std::string first = table("5", "a.csv");
  EXPECT_EQ(table("5", "b.csv"), first);
  EXPECT_NE(table("6", "c.csv"), first);
  const auto rows = table_of(first);
  ASSERT_EQ(rows.size(), 2U + 2U + 1U + 4U);
  std::set<std::string> kinds;
  bool is_in_order = true;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(rows[n].at("order"), std::to_string(n + 1));
    kinds.insert(rows[n].at("task") + rows[n].at("condition") + rows[n].at("hand"));
    is_in_order = is_in_order && (n == 0 || rows[n - 1].at("task") <= rows[n].at("task"));
  }
  EXPECT_EQ(kinds.size(), rows.size()) << "each task, condition and hand once";
  EXPECT_FALSE(is_in_order) << "shuffled";
}

/// The analysis against the table that it is of.
TEST(LabTrial, TellsTheMediansAndQuartilesOfItsTable) {
  const ScratchFolder scratch;
  const auto file = scratch / "dock.csv";
  const json study = trial({"--task", "dock", "--repeats", "2", "-o", file.string()});
  std::vector<double> times;
  for (const auto& row : table_of(content_of(file))) {
    if (row.at("condition") == "force") times.push_back(std::stod(row.at("time_s")));
  }
  ASSERT_EQ(times.size(), 8U);
  std::sort(times.begin(), times.end());
  const json row = row_of(study, "dock", "force");
  EXPECT_EQ(row["trials"], 8);
  EXPECT_NEAR(row["time_s"]["median"], 0.5 * (times[3] + times[4]), 1e-4);
  EXPECT_NEAR(row["time_s"]["q1"], times[1] + 0.75 * (times[2] - times[1]), 1e-4);
  EXPECT_NEAR(row["time_s"]["q3"], times[5] + 0.25 * (times[6] - times[5]), 1e-4);
  EXPECT_NEAR(row["time_s"]["least"], times[0], 1e-4);
  EXPECT_NEAR(row["time_s"]["most"], times[7], 1e-4);
}

/// Of the differences between two conditions.
json pair_of(const json& study, const std::string& task, const std::string& condition) {
  for (const json& pair : study["pairs"]) {
    if (pair["task"] == task && pair["condition"] == condition) return pair;
  }
  ADD_FAILURE() << "no pairs of " << task << ", " << condition;
  return {};
}

/// What force is for, by simulated hands, in places that have nothing in common: a groove guides in
/// every study. Whether a pull docks sooner such a study does not tell (docs/lab.md).
TEST(LabTrial, ShowsThatAGrooveGuidesWhateverTheSeed) {
  for (const char* seed : {"1", "2", "3"}) {
    const json study = trial({"--task", "groove", "--repeats", "3", "--seed", seed});
    const json pair = pair_of(study, "groove", "force");
    EXPECT_EQ(pair["pairs"], 12) << seed;
    EXPECT_LT(pair["error_mm"]["high"], 0.0) << seed;
    EXPECT_GE(pair["error_mm"]["less"], 11) << seed;
  }
}

/// Blindfolded, places being spread over 36 mm.
TEST(LabTrial, FindsTheBumpWithoutSeeingIt) {
  const json bump = row_of(trial({"--task", "bump", "--repeats", "4"}), "bump", "force");
  EXPECT_EQ(bump["started"], 16);
  EXPECT_GE(bump["done"], 11);
  EXPECT_LT(bump["error_mm"]["median"], kBumpMm);
}

/// The three kinds of guidance: in error as their laws say, in every place.
TEST(LabTrial, ComparesTheKindsOfGuidance) {
  const json study = trial({"--task", "path", "--repeats", "2", "--seed", "3"});
  const json direct = pair_of(study, "path", "direct");
  const json indirect = pair_of(study, "path", "indirect");
  const json hybrid = pair_of(study, "path", "hybrid");
  EXPECT_EQ(direct["pairs"], 8);
  EXPECT_EQ(direct["error_mm"]["less"], 8);
  EXPECT_LT(direct["error_mm"]["high"], 0.0);
  EXPECT_EQ(indirect["error_mm"]["less"], 0);
  EXPECT_GT(indirect["error_mm"]["low"], 0.0);
  EXPECT_GT(hybrid["error_mm"]["median"], direct["error_mm"]["median"]);
  EXPECT_LT(hybrid["error_mm"]["median"], indirect["error_mm"]["median"]);
}

TEST(LabTrial, RunsOneTaskByOneHandAndDrawsIt) {
  const ScratchFolder scratch;
  const auto picture = scratch / "trial.svg";
  const json study =
      trial({"--task", "groove", "--hand", "firm", "--repeats", "2", "--plot", picture.string()});
  EXPECT_EQ(study["trials"], 4);
  EXPECT_EQ(row_of(study, "groove", "free", "firm")["trials"], 2);
  const std::string svg = content_of(picture);
  EXPECT_THAT(svg, HasSubstr("Groove"));
  EXPECT_THAT(svg, HasSubstr("firm"));
}

/// A study that is ended is not lost: what was measured stands in FILE.
TEST(LabTrial, KeepsTheTrialsThatHadEnded) {
  const ScratchFolder scratch;
  const auto file = scratch / "trials.csv";
  RunOptions options;
  options.interrupt_when = [&] { return std::filesystem::exists(file); };
  const Ended run = run_argil({"lab", "trial", "--repeats", "100", "-o", file.string()}, options);
  EXPECT_EQ(run.status, 130);
  EXPECT_GE(table_of(content_of(file)).size(), 1U);
}

/// A hand's trials have places of their own, the conditions of one place the same.
TEST(LabTrialPlaces, AreThoseOfAllConditionsAndOfNoOtherHandOrRepeat) {
  TrialOptions options;
  options.repeats = 4;
  std::map<std::uint64_t, std::vector<Trial>> by_place;
  for (const Trial& each : trials_of(options)) by_place[each.place].push_back(each);
  EXPECT_EQ(by_place.size(), kTrialTasks.size() * 4U * 4U);
  for (const auto& [place, group] : by_place) {
    EXPECT_EQ(group.size(), trial_conditions(group.front().task).size());
    for (const Trial& each : group) {
      EXPECT_EQ(each.task, group.front().task);
      EXPECT_EQ(each.hand, group.front().hand);
      EXPECT_EQ(each.repeat, group.front().repeat);
    }
  }
}

TrialResult dock_result(const char* condition, std::uint64_t place, double time_s) {
  TrialResult result;
  result.trial = {TrialTask::dock, condition, static_cast<std::size_t>(place % 4), 1, place};
  result.has_started = result.is_done = true;
  result.time_s = time_s;
  return result;
}

/// Differences in the same places, and an interval around their median.
TEST(LabTrialPairs, TellsByHowMuchAConditionDiffers) {
  std::vector<TrialResult> results;
  for (std::uint64_t place = 0; place < 20; ++place) {
    const double hard = 2.0 * static_cast<double>(place);  // the place matters more
    results.push_back(dock_result("free", place, 10.0 + hard));
    results.push_back(dock_result("force", place, 9.0 + hard + 0.01 * static_cast<double>(place)));
  }
  const json pairs = json::parse(trial_json({}, results)["pairs"].dump());
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0]["condition"], "force");
  EXPECT_EQ(pairs[0]["than"], "free");
  EXPECT_EQ(pairs[0]["pairs"], 20);
  const json& time = pairs[0]["time_s"];
  EXPECT_NEAR(time["median"], -0.905, 1e-9);
  EXPECT_EQ(time["less"], 20);
  EXPECT_LT(time["low"], time["median"]);
  EXPECT_LT(time["median"], time["high"]);
  EXPECT_LT(time["high"], -0.8);
  EXPECT_GT(time["low"], -1.0);
}

/// Nothing was measured, which is not a time of 0.
TEST(LabTrialPairs, LeaveOutWhatNeverBegan) {
  std::vector<TrialResult> results{dock_result("free", 0, 3.0), dock_result("free", 4, 5.0),
                                   dock_result("force", 0, 2.0), dock_result("force", 4, 0.0)};
  results.back().has_started = results.back().is_done = false;
  const auto study = trial_json({}, results);
  const json row = row_of(json::parse(study.dump()), "dock", "force");
  EXPECT_EQ(row["trials"], 2);
  EXPECT_EQ(row["started"], 1);
  EXPECT_EQ(row["time_s"]["median"], 2.0);
  EXPECT_EQ(study["pairs"][0]["pairs"], 1);
  EXPECT_THAT(trial_text(study), HasSubstr("1 of 2 done, 1 never begun and left out"));
  EXPECT_THAT(trial_csv({}, results), HasSubstr("4,dock,force,push,1,0,0,,,,,,\n"));
}

TEST(LabTrialSpread, IntervalHoldsTheMedianAsOftenAsItSays) {
  // Of 300 samples of 25 of an even spread, whose median is 0.5.
  std::uint64_t random = 7;
  int held = 0;
  for (int n = 0; n < 300; ++n) {
    std::vector<double> values;
    for (int i = 0; i < 25; ++i) {
      random = mixed(random);
      values.push_back(static_cast<double>(random >> 11U) * 0x1p-53);
    }
    const MedianInterval found = median_interval({values}, 1);
    held += found.low <= 0.5 && 0.5 <= found.high ? 1 : 0;
    EXPECT_LE(found.low, found.median);
    EXPECT_LE(found.median, found.high);
  }
  EXPECT_GE(held, 300 * 88 / 100);
}

TEST(LabTrialSpread, IsTheSameForTheSameSeed) {
  const std::vector<std::vector<double>> groups{{1.0, 2.0, 5.0, 3.0}, {}, {4.0, 9.0, 2.0}};
  const MedianInterval first = median_interval(groups, 3);
  const MedianInterval again = median_interval(groups, 3);
  EXPECT_EQ(first.median, 3.0);
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
}

/// Guidance is not the clay: unguided it is nothing, whatever the clay gives.
TEST(LabTrial, TellsTheForceOfGuidanceApart) {
  const json study = trial({"--task", "path", "--hand", "arm", "--repeats", "1"});
  EXPECT_EQ(row_of(study, "path", "none")["aid_n"]["most"], 0.0);
  EXPECT_EQ(row_of(study, "path", "none")["aid_mj"]["most"], 0.0);
  EXPECT_GT(row_of(study, "path", "none")["effort_n"]["least"], 1.0);
  for (const char* kind : {"direct", "indirect"}) {
    const double aid_n = row_of(study, "path", kind)["aid_n"]["median"];
    EXPECT_GT(aid_n, 0.01) << kind;
    EXPECT_LE(aid_n, 1.5) << kind;
  }
}

TEST(LabTrialBadInput, IsRefusedByName) {
  struct Case {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Case> cases{
      {{"trial", "--active"}, 2, "--active is of a scene"},
      {{"trial", "--set", "k=3"}, 2, "--set is of a scene"},
      {{"trial", "--guide", "direct"}, 2, "--guide is of a scene"},
      {{"trial", "--seed", "-1"}, 2, "--seed"},
      {{"trial", "--repeats", "0"}, 2, "--repeats"},
      {{"trial", "--task", "juggle"}, 2, "--task is 'juggle'"},
      {{"trial", "--device", "replay:run.csv"}, 3, "sim or falcon"},
      {{"trial", "--firmware", "f.bin"}, 3, "--device falcon"},
      {{"trial", "-o", "no/such/run.csv"}, 5, "no/such"},
      {{"trial", "-o", "run.txt"}, 2, "--output"},
      {{"sphere", "--seed", "3"}, 2, "--seed is of 'trial'"},
      {{"sphere", "--task", "dock"}, 2, "--task is of 'trial'"},
  };
  for (const Case& each : cases) {
    std::vector<std::string> words{"lab"};
    words.insert(words.end(), each.words.begin(), each.words.end());
    const Ended run = run_argil(words);
    EXPECT_EQ(run.status, each.status) << each.says << ": " << run.err;
    EXPECT_THAT(run.err, HasSubstr(each.says));
  }
}

}  // namespace
}  // namespace argil::test
