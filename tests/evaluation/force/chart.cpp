// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart force: what its files hold, that they repeat, and what they say of the default.
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

using nlohmann::json;

void expect_methods(const std::vector<CsvRow>& rows) {
  for (const std::string method : {"point", "stencil_96", "stencil_768", "blanch_4", "blanch_16",
                                   "energy_4", "energy_16", "lod", "servo", "lod_blanch", "fine"}) {
    const auto is_method = [&](const CsvRow& row) { return row.at("method") == method; };
    EXPECT_GE(std::count_if(rows.begin(), rows.end(), is_method), 18) << method;
  }
}

void expect_files(const json& report, const std::filesystem::path& folder) {
  const auto [comment, rows] = read_csv(folder / "force.csv");
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  EXPECT_THAT(comment, testing::StartsWith("# "));
  EXPECT_THAT(comment, testing::HasSubstr(report["hash"].get<std::string>()));
  EXPECT_GE(report["files"].size(), 6U);
  for (const json& file : report["files"]) {
    EXPECT_GT(std::filesystem::file_size(file.get<std::string>()), 0U) << file;
  }
  expect_methods(rows);
}

void expect_columns(const std::vector<CsvRow>& rows) {
  for (const CsvRow& row : rows) {
    if (row.at("method") != "lod") continue;
    for (const char* column :
         {"samples", "queries", "error_p50_pct", "error_p95_pct", "shallow_error_p95_pct",
          "direction_p99_deg", "torque_p95_pct", "ripple_rms_p95_pct", "ripple_pp_max_pct",
          "bound_held_pct", "opposed_p95", "cpu_p50_us", "cpu_p99_us", "cpu_max_us"}) {
      EXPECT_GE(csv_value(row, column), 0.0) << column;
    }
  }
}

/// A window is made of nothing, after a move and after a dab, of every ball of the timed sizes.
void expect_windows(const std::vector<CsvRow>& rows) {
  int timed = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "servo") continue;
    const bool is_timed = row.at("tool") == "ball" &&
                          (row.at("radius_voxels") == "4" || row.at("radius_voxels") == "16" ||
                           row.at("radius_voxels") == "64");
    timed += is_timed ? 1 : 0;
    for (const char* column : {"window_fresh_us", "window_moved_us", "window_after_dab_us"}) {
      EXPECT_EQ(!row.at(column).empty(), is_timed) << column;
      if (is_timed) {
        EXPECT_GT(csv_value(row, column), csv_value(row, "cpu_p50_us")) << column;
      }
    }
  }
  EXPECT_GT(timed, 0);
}

/// What the servo chooses is the sum or as good as it: no slower by more than the choice, and no
/// error larger than the 1 % that the centre may have.
void expect_servo_as_good(const std::vector<CsvRow>& rows) {
  for (const CsvRow& row : rows) {
    if (row.at("method") != "servo") continue;
    const auto sum = std::ranges::find_if(rows, [&](const CsvRow& each) {
      return each.at("method") == "lod" && each.at("scene") == row.at("scene");
    });
    ASSERT_NE(sum, rows.end());
    for (const char* column : {"error_p50_pct", "error_p95_pct"}) {
      EXPECT_LE(csv_value(row, column), csv_value(*sum, column) + 0.5)
          << row.at("scene") << ' ' << column;
    }
  }
}

/// The limits of docs/forces.md.
void expect_promise(const std::vector<CsvRow>& rows) {
  int smooth_scenes = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "lod" && row.at("method") != "servo") continue;
    const bool smooth = row.at("group") == "smooth";
    smooth_scenes += smooth ? 1 : 0;
    const std::string& scene = row.at("scene");
    EXPECT_LE(csv_value(row, "error_p95_pct"), smooth ? 1.0 : 3.0) << scene;
    EXPECT_LE(csv_value(row, "shallow_error_p95_pct"), smooth ? 1.0 : 3.0) << scene;
    EXPECT_LE(csv_value(row, "direction_p99_deg"), 2.0) << scene;
    EXPECT_LE(csv_value(row, "torque_p95_pct"), 2.0) << scene;
    // Taps that stop at creases cost what is sharp some smoothness (docs/forces.md).
    EXPECT_LE(csv_value(row, "ripple_rms_p95_pct"), smooth ? 0.5 : 0.55) << scene;
    EXPECT_LE(csv_value(row, "ripple_pp_max_pct"), 2.0) << scene;
  }
  EXPECT_GE(smooth_scenes, 6);  // plane, torus and both together, by lod and as the servo does
}

// One test, since each runs in a program of its own and would make the chart again.
TEST(ChartForceSlow, WritesItsFilesRepeatsAndFindsTheDefaultWithinItsPromise) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "force", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const json first = make("first");
  ASSERT_TRUE(first.contains("hash"));
  expect_files(first, scratch / "first");
  expect_columns(read_csv(scratch / "first" / "force.csv").rows);
  expect_windows(read_csv(scratch / "first" / "force.csv").rows);
  expect_servo_as_good(read_csv(scratch / "first" / "force_by_scene.csv").rows);
  expect_promise(read_csv(scratch / "first" / "force_by_scene.csv").rows);
  EXPECT_EQ(make("second")["hash"], first["hash"]);
}

/// The one that docs/forces.md shows; LatticeForce.* also tests what it says of the default.
TEST(ChartForce, KeptOneHasEveryMethodAndColumn) {
  const std::vector<CsvRow> rows = read_csv("docs/charts/force.csv").rows;
  expect_methods(rows);
  expect_columns(rows);
  expect_windows(rows);
}

TEST(ChartFailures, DrawsEveryPanel) {
  const ScratchFolder scratch;
  const Ended run = run_argil({"chart", "failures", "-o", (scratch / "f").string(), "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(run.json()["rows"].get<int>(), 500);
  const std::string text = text_of(scratch / "f" / "force_failures.csv");
  for (const char* panel : {"saturates", "thin sheet", "rough matter", "Sliding", "closed path"}) {
    EXPECT_THAT(text, testing::HasSubstr(panel));
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / "f" / "force_failures.svg"));
}

TEST(ChartForce, RefusesAnUnknownKind) {
  const Ended run = run_argil({"chart", "weather", "--json"});
  EXPECT_EQ(run.status, 2);
}

}  // namespace
}  // namespace argil::test
