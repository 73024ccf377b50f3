// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart memory: that it repeats, and that its figures are those of docs/field.md.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "evaluation/csv.h"
#include "support/effort.h"
#include "support/models.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

constexpr double kBandVoxels = 8.0;  // both sides together

/// Everything but what the process had to say.
void expect_same_rows(const std::vector<CsvRow>& first, const std::vector<CsvRow>& second) {
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (const auto& [column, value] : first[i]) {
      if (column != "process_bytes") {
        EXPECT_EQ(value, second[i].at(column)) << first[i].at("piece") << " " << column;
      }
    }
  }
}

/// Detail everywhere: the finest level holds the band, and no level more than the surface asks for.
void expect_ball(const CsvRow& row) {
  const double detail = 0.5 * csv_value(row, "voxels_across");
  SCOPED_TRACE("ball, R/h " + std::to_string(detail));
  // A band of a sphere, counted in closed form, is what the levels made whole must hold.
  const double half = 0.5 * kBandVoxels;
  const double band = 4.0 * std::numbers::pi * kBandVoxels * (detail * detail + half * half / 3.0);
  const double whole = csv_value(row, "whole_finest_active");
  EXPECT_NEAR(whole / band, 1.0, 0.01);
  EXPECT_GE(csv_value(row, "finest_active"), 0.9 * whole);
  EXPECT_LE(csv_value(row, "finest_leaf_bytes"), 7.0 * csv_value(row, "finest_active"));
  EXPECT_LE(csv_value(row, "leaves_to_finest"), 1.65);
  const double trees = csv_value(row, "stack_bytes") - csv_value(row, "stack_leaf_bytes");
  EXPECT_LE(trees, 3e6 * csv_value(row, "levels"));
  if (detail < 128.0) return;
  EXPECT_LE(csv_value(row, "bytes_per_active"), 16.0);
  EXPECT_LE(csv_value(row, "leaves_to_finest"), 1.53);
}

void expect_any(const CsvRow& row) {
  SCOPED_TRACE(row.at("piece"));
  EXPECT_LT(csv_value(row, "stack_bytes"), csv_value(row, "whole_bytes"));
  EXPECT_LE(csv_value(row, "finest_active"), csv_value(row, "whole_finest_active"));
  EXPECT_GT(csv_value(row, "finest_active"), 0.0);
#ifndef __SANITIZE_ADDRESS__  // its heap is not the one that mallinfo2 tells of
  EXPECT_NEAR(csv_value(row, "process_bytes") / csv_value(row, "stack_bytes"), 1.0, 0.1);
#endif
}

TEST(ChartMemory, RepeatsAndGrowsWithTheSurfaceAlone) {
  const ScratchFolder scratch;
  ::setenv("ARGIL_SHARED", shared_models().parent_path().c_str(), 1);
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "memory", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json report = make("first");
  const std::vector<CsvRow> rows = read_csv(scratch / "first" / "memory.csv").rows;
  // Usually it is cheaper charts' part to repeat.
  if (effort(false, true)) {
    make("second");
    expect_same_rows(rows, read_csv(scratch / "second" / "memory.csv").rows);
  }
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  for (const nlohmann::json& file : report["files"]) {
    EXPECT_FALSE(text_of(file.get<std::string>()).empty()) << file;
  }
  EXPECT_NEAR(report["growth_exponent"]["active_voxels"].get<double>(), 2.0, 0.1);
  EXPECT_NEAR(report["growth_exponent"]["leaf_bytes"].get<double>(), 2.0, 0.1);
  std::size_t balls = 0;
  for (const CsvRow& row : rows) {
    expect_any(row);
    if (row.at("kind") == "ball") {
      expect_ball(row);
      ++balls;
    }
    if (row.at("piece") == "engraved ball") {
      EXPECT_GE(csv_value(row, "whole_bytes"), 2.5 * csv_value(row, "stack_bytes"));
    }
  }
  EXPECT_EQ(balls, 3U);
  // Three models and the engraved ball; a model that is not there is named.
  EXPECT_EQ(rows.size() - balls + report["skipped"].size(), 4U);
}

}  // namespace
}  // namespace argil::test
