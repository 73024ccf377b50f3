// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability: that it repeats, and what its rows say of every remedy.
#include <algorithm>
#include <filesystem>
#include <map>
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

std::string stability_label(const CsvRow& row) {
  return row.at("method") + " " + row.at("device") + " " + row.at("hand") + ", delay " +
         row.at("delay_ticks") + ", " + row.at("period_ms") + " ms";
}

/// Without friction and remedy the simulated hold cycles where the eigenvalue says.
void expect_eigenvalue(const std::vector<CsvRow>& rows) {
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "direct" || row.at("device") != "frictionless") continue;
    const bool is_fast = csv_value(row, "period_ms") <= 2.0;
    const double ratio = csv_value(row, "first_limit_cycle") / csv_value(row, "eigenvalue");
    EXPECT_GE(ratio, is_fast ? 0.75 : 0.6) << stability_label(row);
    EXPECT_LE(ratio, is_fast ? 1.15 : 1.2) << stability_label(row);
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

void expect_default_quiet(const std::vector<CsvRow>& rows) {
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "default") continue;
    EXPECT_EQ(row.at("verdict"), "quiet") << stability_label(row);
    EXPECT_EQ(row.at("first_not_quiet"), ">= 60000") << stability_label(row);
    ++compared;
  }
  EXPECT_GE(compared, 60);  // 4 hands, 3 delays, 5 periods
}

void expect_ungoverned_fails_when_slow(const std::vector<CsvRow>& rows) {
  int failures = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "indirect_1500" || csv_value(row, "period_ms") < 2.0) continue;
    failures += row.at("verdict") != "quiet" ? 1 : 0;
  }
  EXPECT_GT(failures, 0);
}

void expect_filter_never_better(const std::vector<CsvRow>& rows) {
  std::map<std::string, double> direct;
  const auto key = [](const CsvRow& row) {
    return row.at("device") + row.at("hand") + row.at("delay_ticks") + row.at("period_ms");
  };
  for (const CsvRow& row : rows) {
    if (row.at("method") == "direct") direct[key(row)] = csv_value(row, "first_limit_cycle");
  }
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "position_filter") continue;
    EXPECT_LE(csv_value(row, "first_limit_cycle"), direct.at(key(row))) << stability_label(row);
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

/// What fixes what: the coupling everything, the filters nothing.
void expect_remedies(const std::vector<CsvRow>& rows) {
  for (const CsvRow& row : rows) {
    const std::string& remedy = row.at("remedy");
    const std::string what = row.at("contact") + " " + remedy + " " + row.at("hand");
    if (remedy == "default" || remedy == "coupling 1500") {
      EXPECT_EQ(row.at("verdict"), "quiet") << what;
    }
    if (row.at("contact") == "rigid 20 N" && remedy != "default" && remedy != "coupling 1500") {
      EXPECT_EQ(row.at("verdict"), "limit_cycle") << what;
    }
  }
}

/// The largest slope that the clamp lets a ball feel is below the limit of every hand from 2 mm on.
void expect_volume(const std::filesystem::path& folder) {
  for (const CsvRow& row : read_csv(folder / "stability_volume.csv").rows) {
    if (row.at("servo") == "default" || csv_value(row, "radius_mm") >= 2.0) {
      EXPECT_EQ(row.at("verdict"), "quiet")
          << row.at("servo") << " " << row.at("radius_mm") << " " << row.at("skin_mm");
    }
  }
  for (const CsvRow& row : read_csv(folder / "stability_volume_limit.csv").rows) {
    if (row.at("slope_at_limit_cycle").empty()) continue;
    const double ratio =
        csv_value(row, "slope_at_limit_cycle") / csv_value(row, "linear_wall_limit_cycle");
    EXPECT_GT(ratio, 0.7) << row.at("hand") << " " << row.at("radius_mm");
    EXPECT_LT(ratio, 1.4) << row.at("hand") << " " << row.at("radius_mm");
  }
}

/// Clay in windows: contact alone it is what the closed form is, the default is quiet, and carving
/// gives nothing to the hand.
void expect_sampled(const std::filesystem::path& folder) {
  int passive = 0;
  int carving = 0;
  for (const CsvRow& row : read_csv(folder / "stability_sampled.csv").rows) {
    const std::string what = row.at("state") + " " + row.at("hand") + " " + row.at("servo");
    if (row.at("verdict") == "quiet") {
      EXPECT_EQ(row.at("window"), "kept") << what;
    }
    if (row.at("servo") == "default") {
      EXPECT_EQ(row.at("verdict"), "quiet") << what;
    }
    if (row.at("drag") == "no") {
      EXPECT_EQ(row.at("verdict"), row.at("closed_form")) << what;
      EXPECT_NEAR(csv_value(row, "slope_felt") / csv_value(row, "slope_at_rest"), 1.0, 0.02)
          << what;
      ++passive;
    }
    if (row.at("state") != "carving") continue;
    EXPECT_NE(row.at("verdict"), "limit_cycle") << what;
    EXPECT_LT(csv_value(row, "work_mj"), 0.0) << what;
    EXPECT_GT(csv_value(row, "dabs"), 10.0) << what;
    ++carving;
  }
  EXPECT_GE(passive, 2);
  EXPECT_GE(carving, 4);
  for (const CsvRow& row : read_csv(folder / "stability_sampled_limit.csv").rows) {
    const double closed_slope = csv_value(row, "closed_form_slope");
    EXPECT_GT(closed_slope, 0.0);
    EXPECT_NEAR(csv_value(row, "sampled_slope") / closed_slope, 1.0, 0.25);  // a step of the grid
  }
}

/// The cells are felt less than theory C.4's smooth kernel of 16 nodes has them.
void expect_cogging(const std::filesystem::path& folder) {
  int prescribed = 0;
  int in_hand = 0;
  for (const CsvRow& row : read_csv(folder / "stability_cogging.csv").rows) {
    const std::string what = row.at("radius_mm") + " mm, " + row.at("hand");
    if (row.at("hand") == "none") {
      EXPECT_LT(csv_value(row, "cogging"), csv_value(row, "theory_16")) << what;
      EXPECT_GT(csv_value(row, "normal_pp_pct"), 0.0) << what;
      ++prescribed;
    } else if (row.at("drag") == "no") {
      EXPECT_EQ(row.at("verdict"), row.at("closed_form")) << what;
      ++in_hand;
    }
  }
  EXPECT_GE(prescribed, 8);
  EXPECT_GE(in_hand, 1);
}

/// What holds of the quick chart and of the one that docs/stability.md shows.
void expect_remedies_help(const std::filesystem::path& folder) {
  const std::vector<CsvRow> rows = read_csv(folder / "stability_stiffness.csv").rows;
  expect_default_quiet(rows);
  expect_ungoverned_fails_when_slow(rows);
  expect_filter_never_better(rows);
  expect_remedies(read_csv(folder / "stability_cases.csv").rows);
  expect_volume(folder);
}

TEST(ChartStability, KeptOneFindsTheDefaultQuiet) { expect_remedies_help("docs/charts"); }

TEST(ChartStability, LeavesNoFileWhenItIsInterrupted) {
  const ScratchFolder scratch;
  const std::filesystem::path charts = scratch / "charts";
  RunOptions interrupted;
  interrupted.interrupt_when = [&] { return std::filesystem::exists(charts); };
  const Ended run =
      run_argil({"chart", "stability", "--quick", "-o", charts.string()}, interrupted);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(run.err, testing::HasSubstr("nothing was written"));
  EXPECT_TRUE(std::filesystem::is_empty(charts));
}

// One test, since each runs in a program of its own and would make the chart again.
TEST(ChartStabilitySlow, RepeatsAndFindsTheDefaultQuiet) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "stability", "--quick", "-o", (scratch / name).string(), "--json"});
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
  expect_eigenvalue(read_csv(scratch / "first" / "stability_stiffness.csv").rows);
  expect_remedies_help(scratch / "first");
  expect_sampled(scratch / "first");
  expect_cogging(scratch / "first");
}

}  // namespace
}  // namespace argil::test
