// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability --damping: that it repeats, and what its rows say of adaptive damping.
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
  EXPECT_LT(adaptive_cycles, fixed_cycles / 2);
}

/// Free motion and slides along a flat wall cost nothing.
void expect_damping_is_not_felt(const std::filesystem::path& folder) {
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

/// What holds of the quick chart and of the one that docs/stability.md shows.
void expect_damping(const std::filesystem::path& folder) {
  expect_damping_calms(folder);
  expect_damping_is_not_felt(folder);
}

TEST(ChartStabilityDamping, KeptOneCalmsWhatCycles) { expect_damping("docs/charts"); }

TEST(ChartStabilityDamping, IsNotMadeTogetherWithTheLateOne) {
  const Ended run = run_argil({"chart", "stability", "--late", "--damping"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("--damping"));
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
