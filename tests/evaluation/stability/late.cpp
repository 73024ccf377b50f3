// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability --late: that it repeats, and what its rows promise of the servo.
#include <algorithm>
#include <filesystem>
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

std::string late_label(const CsvRow& row) {
  return row.at("way") + " " + row.at("action") + " " + row.at("tool") + " " + row.at("hand") +
         " " + row.at("servo") + " " + row.at("remedy") + ", A " + row.at("age_ms") + ", P " +
         row.at("period_ms");
}

bool is_row(const CsvRow& row, const char* way, const char* action, const char* remedy) {
  return row.at("way") == way && row.at("action") == action && row.at("remedy") == remedy;
}

/// A spring that is stiff enough cycles where the equation says, in the hands and without a
/// coupling.
void expect_equation_holds(const std::vector<CsvRow>& limits) {
  int compared = 0;
  for (const CsvRow& row : limits) {
    if (row.at("servo") != "direct" || csv_value(row, "k_n_per_m") < 1200.0) continue;
    EXPECT_GE(csv_value(row, "ratio"), 0.95) << row.at("hand") << " " << row.at("k_n_per_m");
    EXPECT_LE(csv_value(row, "ratio"), 1.10) << row.at("hand") << " " << row.at("k_n_per_m");
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

/// Removing gives nothing at any age to a hand behind the coupling. Without one it falls into the
/// clay so fast that old windows do not know it there, and a stamp may be corrected by a window:
/// far less than the account pays.
void expect_removing_gives_nothing(const std::vector<CsvRow>& rows) {
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("action") != "carve" || csv_value(row, "outside_ms") > 0) continue;
    const bool is_plain = row.at("remedy") != "stamped" && row.at("servo") == "default";
    EXPECT_LE(csv_value(row, "exchange_mw"), is_plain ? 0.0 : 0.5) << late_label(row);
    ++compared;
  }
  EXPECT_GE(compared, 30);
}

void expect_account_bounds_adding(const std::vector<CsvRow>& rows) {
  double most_before_mj = 0.0;
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("servo") != "default") continue;
    if (is_row(row, "clay", "add", "blended")) {
      most_before_mj = std::max(most_before_mj, csv_value(row, "given_mj"));
    }
    if (!is_row(row, "clay", "add", "account")) continue;
    EXPECT_LE(csv_value(row, "given_mj"), csv_value(row, "allowed_mj")) << late_label(row);
    EXPECT_LE(csv_value(row, "given_mj"), 2.5) << late_label(row);
    EXPECT_NE(row.at("verdict"), "limit_cycle") << late_label(row);
    ++compared;
  }
  EXPECT_GE(compared, 4);
  EXPECT_GT(most_before_mj, 4.0) << "nothing that an account would have to pay";
}

/// On real clay, through the program's own servo: a calm hand, and no step at an exchange.
void expect_stamps_calm(const std::vector<CsvRow>& rows) {
  int compared = 0;
  double most_before_n = 0.0;
  for (const CsvRow& row : rows) {
    if (row.at("way") != "clay" || row.at("action") != "carve") continue;
    if (row.at("servo") != "default" || row.at("tool") != "fine") continue;
    if (row.at("age_ms") != "50" || row.at("period_ms") != "50") continue;
    if (row.at("remedy") == "account") {
      most_before_n = std::max(most_before_n, csv_value(row, "mean_n"));
    }
    if (row.at("remedy") != "stamped") continue;
    EXPECT_EQ(row.at("verdict"), "quiet") << late_label(row);
    EXPECT_EQ(row.at("window"), "kept") << late_label(row);
    EXPECT_LE(csv_value(row, "swing_mm"), 0.03) << late_label(row);
    EXPECT_LE(csv_value(row, "step_p99_n"), 0.05) << late_label(row);
    EXPECT_LE(csv_value(row, "mean_n"), 0.5) << late_label(row);
    ++compared;
  }
  EXPECT_EQ(compared, 4);
  EXPECT_GT(most_before_n, 1.0);
}

/// What holds of the quick chart and of the one that docs/stability.md shows.
void expect_late(const std::filesystem::path& folder) {
  const std::vector<CsvRow> rows = read_csv(folder / "stability_late.csv").rows;
  expect_equation_holds(read_csv(folder / "stability_late_limit.csv").rows);
  expect_removing_gives_nothing(rows);
  expect_account_bounds_adding(rows);
  expect_stamps_calm(rows);
}

TEST(ChartStabilityLate, KeptOneHoldsWhatTheServoPromises) { expect_late("docs/charts"); }

TEST(ChartStabilityLate, LeavesNoFileWhenItIsInterrupted) {
  const ScratchFolder scratch;
  const std::filesystem::path charts = scratch / "charts";
  RunOptions interrupted;
  interrupted.interrupt_when = [&] { return std::filesystem::exists(charts); };
  const Ended run =
      run_argil({"chart", "stability", "--late", "--quick", "-o", charts.string()}, interrupted);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(run.err, testing::HasSubstr("nothing was written"));
  EXPECT_TRUE(std::filesystem::is_empty(charts));
}

// One test, since each runs in a program of its own and would make the chart again.
TEST(ChartStabilityLateSlow, RepeatsAndHoldsWhatTheServoPromises) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run = run_argil(
        {"chart", "stability", "--late", "--quick", "-o", (scratch / name).string(), "--json"});
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
  expect_late(scratch / "first");
}

}  // namespace
}  // namespace argil::test
