// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart bridge: that it repeats, and what the map says of the three laws.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/run_argil.h"
#include "evaluation/csv.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using CsvRows = std::vector<CsvRow>;

/// The lowest stiffness of a law at that rate and delay that is not quiet.
double first_not_quiet(const CsvRows& rows, const std::string& law, double rate_hz,
                       double delay_ms) {
  double least = 1e9;
  for (const CsvRow& row : rows) {
    const bool is_asked = row.at("law") == law && csv_value(row, "rate_hz") == rate_hz &&
                          csv_value(row, "delay_ms") == delay_ms;
    if (is_asked && row.at("verdict") != "quiet") {
      least = std::min(least, csv_value(row, "k_n_per_m"));
    }
  }
  return least;
}

std::set<double> values_of(const CsvRows& rows, const std::string& column) {
  std::set<double> values;
  for (const CsvRow& row : rows) values.insert(csv_value(row, column));
  return values;
}

TEST(ChartBridge, RepeatsAndMapsTheThreeLaws) {
  ARGIL_CLIENT_OR_SKIP("gnuplot");
  const ScratchFolder folder;
  // Usually a coarse map, where only its lowest rate is slow enough for the stiffness asked below.
  const bool is_full = effort(false, true);
  const double slow_hz = is_full ? 58.13 : 20.0;
  const double fast_hz = is_full ? 241.1 : 271.4;
  const auto make = [&](const char* name) {
    std::vector<std::string> words{"chart", "bridge", "-o", (folder / name).string(), "--quiet"};
    if (!is_full) words.emplace_back("--quick");
    const Ended run = run_argil(words);
    EXPECT_EQ(run.status, 0) << run.err;
  };
  make("a");
  // That the same run gives the same bits is BridgeRunGolden as well.
  if (is_full) {
    make("b");
    EXPECT_EQ(content_of(folder / "a/bridge.csv"), content_of(folder / "b/bridge.csv"));
  }
  EXPECT_GT(std::filesystem::file_size(folder / "a/bridge.svg"), 10000U);
  const CsvRows rows = read_csv(folder / "a/bridge.csv").rows;
  const std::set<double> rates = values_of(rows, "rate_hz");
  const std::set<double> delays = values_of(rows, "delay_ms");
  EXPECT_GE(rates.size(), is_full ? 8U : 4U);
  EXPECT_GE(delays.size(), 3U);
  for (const CsvRow& row : rows) {
    // k T = 2 b for 3 N s/m, T the simulator's period or the servo's.
    const double rate_hz = row.at("law") == "direct" ? csv_value(row, "rate_hz") : 1000.0;
    EXPECT_NEAR(csv_value(row, "rule_n_per_m"), 6.0 * rate_hz, 0.03 * rate_hz);
  }
  for (const double delay_ms : delays) {
    for (const double rate_hz : rates) {
      EXPECT_GT(first_not_quiet(rows, "plane", rate_hz, delay_ms), 6000.0)
          << "the servo's loop alone: " << rate_hz << " Hz, " << delay_ms << " ms";
    }
  }
  EXPECT_LE(first_not_quiet(rows, "direct", slow_hz, 0.0), 1500.0);
  EXPECT_GT(first_not_quiet(rows, "direct", fast_hz, 0.0), 1500.0);
  EXPECT_LE(first_not_quiet(rows, "direct", fast_hz, 20.0), 1500.0) << "the rule knows no delay";
  EXPECT_GT(first_not_quiet(rows, "indirect", slow_hz, 0.0), 1500.0);
}

}  // namespace
}  // namespace argil::test
