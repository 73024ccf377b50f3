// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability --damping: that it repeats, and what its rows say of adaptive damping.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "evaluation/csv.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

/// The walls of c = 0 of the nominal device: cycles of both kinds, and what adaptive damping adds.
void expect_damping_calms(const std::filesystem::path& folder) {
  int fixed_cycles = 0;
  int adaptive_cycles = 0;
  for (const CsvRow& row : read_csv(folder / "stability_damping.csv").rows) {
    const bool is_adaptive = row.at("damping") == "adaptive";
    const std::string label = row.at("device") + " " + row.at("hand") + " " + row.at("damping") +
                              ", K " + row.at("k_n_per_m") + ", c " + row.at("c_n_s_per_m");
    EXPECT_LE(csv_value(row, "added_most_n_s_per_m"), is_adaptive ? 50.1 : 0.0) << label;
    if (row.at("verdict") == "limit_cycle") {
      EXPECT_EQ(row.at("settle_ms"), "") << label;
    }
    if (row.at("c_n_s_per_m") != "0" || row.at("device") != "nominal") continue;
    const bool cycles = row.at("verdict") == "limit_cycle";
    (is_adaptive ? adaptive_cycles : fixed_cycles) += cycles ? 1 : 0;
  }
  EXPECT_GT(fixed_cycles, 4);
  // 11 of 35 on the chart that is kept; the quick one has 9 walls at most.
  EXPECT_LE(2 * adaptive_cycles, fixed_cycles);
}

/// Free motion costs nothing.
void expect_no_damping_in_free_motion(const std::filesystem::path& folder) {
  int compared = 0;
  for (const CsvRow& row : read_csv(folder / "stability_damping_motion.csv").rows) {
    if (row.at("damping") != "adaptive") continue;
    if (!row.at("motion").starts_with("free")) continue;
    EXPECT_EQ(row.at("added_most_n_s_per_m"), "0") << row.at("hand");
    EXPECT_EQ(row.at("taken_mj"), "0") << row.at("hand");
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

/// A slide along a flat wall costs the tap that it begins with: less than a millijoule more than
/// without a damper, and less than with one of 10 or 50 N s/m all the time.
void expect_a_slide_costs_its_tap(const std::filesystem::path& folder) {
  std::map<std::string, double> taken_mj;  // by motion, hand and damper
  std::set<std::string> slides;
  for (const CsvRow& row : read_csv(folder / "stability_damping_motion.csv").rows) {
    if (!row.at("motion").starts_with("slide")) continue;
    const std::string who = row.at("motion") + " " + row.at("hand");
    slides.insert(who);
    taken_mj[who + " " + row.at("damping") + " " + row.at("c_n_s_per_m")] =
        csv_value(row, "taken_mj");
  }
  EXPECT_EQ(slides.size(), 6U);
  for (const std::string& who : slides) {
    const double adaptive_mj = taken_mj.at(who + " adaptive 0");
    EXPECT_LT(adaptive_mj, taken_mj.at(who + " fixed 0") + 1.0) << who;
    EXPECT_LT(adaptive_mj, taken_mj.at(who + " fixed 10")) << who;
    EXPECT_LT(adaptive_mj, taken_mj.at(who + " fixed 50")) << who;
  }
}

/// It is set against the damper that it may come to.
void expect_the_bound_is_there(const std::filesystem::path& folder) {
  for (const char* table :
       {"stability_damping.csv", "stability_damping_period.csv", "stability_damping_motion.csv"}) {
    int rows = 0;
    for (const CsvRow& row : read_csv(folder / table).rows) {
      rows += row.at("damping") == "fixed" && row.at("c_n_s_per_m") == "50" ? 1 : 0;
    }
    EXPECT_GT(rows, 0) << table;
  }
}

/// What holds of the quick chart and of the one that docs/stability.md shows.
void expect_damping(const std::filesystem::path& folder) {
  expect_damping_calms(folder);
  expect_no_damping_in_free_motion(folder);
  expect_a_slide_costs_its_tap(folder);
  expect_the_bound_is_there(folder);
}

TEST(ChartStabilityDamping, KeptOneCalmsWhatCycles) { expect_damping("docs/charts"); }

TEST(ChartStabilityDamping, IsNotMadeTogetherWithTheLateOne) {
  const Ended run = run_argil({"chart", "stability", "--late", "--damping"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("--damping"));
  EXPECT_THAT(run.err, testing::HasSubstr("see 'argil chart stability --help'"));
}

// One test, since each runs in a program of its own and would make the chart again.
TEST(ChartStabilityDampingSlow, RepeatsAndCalmsWhatCycles) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run = run_argil(
        {"chart", "stability", "--damping", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json first = make("first");
  make("second");
  for (const nlohmann::json& file : first["files"]) {
    const std::filesystem::path path = file.get<std::string>();
    EXPECT_FALSE(text_of(path).empty()) << path;
    if (path.extension() != ".csv") continue;
    EXPECT_EQ(text_of(path), text_of(scratch / "second" / path.filename())) << path;
  }
  expect_damping(scratch / "first");
}

}  // namespace
}  // namespace argil::test
