// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart stability: that it repeats, and what its rows say of every remedy.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_argil.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using CsvRow = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::string field;
  std::istringstream stream(line);
  while (std::getline(stream, field, ',')) fields.push_back(field);
  return fields;
}

/// The rows by the names of the header, which follows one line of comment.
std::vector<CsvRow> read_csv(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::getline(stream, line);
  const std::vector<std::string> names = split(line);
  std::vector<CsvRow> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = split(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    CsvRow row;
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) {
      row[names[i]] = fields[i];
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A stiffness; of ">= 60000" the number.
double value(const CsvRow& row, const std::string& column) {
  const std::string& text = row.at(column);
  return std::strtod(text.c_str() + (text.starts_with(">= ") ? 3 : 0), nullptr);
}

std::string label(const CsvRow& row) {
  return row.at("method") + " " + row.at("device") + " " + row.at("hand") + ", delay " +
         row.at("delay_ticks") + ", " + row.at("period_ms") + " ms";
}

/// Without friction and remedy the simulated hold cycles where the eigenvalue says.
void expect_eigenvalue(const std::vector<CsvRow>& rows) {
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "direct" || row.at("device") != "frictionless") continue;
    const bool is_fast = value(row, "period_ms") <= 2.0;
    const double ratio = value(row, "first_limit_cycle") / value(row, "eigenvalue");
    EXPECT_GE(ratio, is_fast ? 0.75 : 0.6) << label(row);
    EXPECT_LE(ratio, is_fast ? 1.15 : 1.2) << label(row);
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

void expect_default_quiet(const std::vector<CsvRow>& rows) {
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "default") continue;
    EXPECT_EQ(row.at("verdict"), "quiet") << label(row);
    EXPECT_EQ(row.at("first_not_quiet"), ">= 60000") << label(row);
    ++compared;
  }
  EXPECT_GE(compared, 60);  // 4 hands, 3 delays, 5 periods
}

void expect_ungoverned_fails_when_slow(const std::vector<CsvRow>& rows) {
  int failures = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "indirect_1500" || value(row, "period_ms") < 2.0) continue;
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
    if (row.at("method") == "direct") direct[key(row)] = value(row, "first_limit_cycle");
  }
  int compared = 0;
  for (const CsvRow& row : rows) {
    if (row.at("method") != "position_filter") continue;
    EXPECT_LE(value(row, "first_limit_cycle"), direct.at(key(row))) << label(row);
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
  for (const CsvRow& row : read_csv(folder / "stability_volume.csv")) {
    if (row.at("servo") == "default" || value(row, "radius_mm") >= 2.0) {
      EXPECT_EQ(row.at("verdict"), "quiet")
          << row.at("servo") << " " << row.at("radius_mm") << " " << row.at("skin_mm");
    }
  }
  for (const CsvRow& row : read_csv(folder / "stability_volume_limit.csv")) {
    if (row.at("slope_at_limit_cycle").empty()) continue;
    const double ratio = value(row, "slope_at_limit_cycle") / value(row, "linear_wall_limit_cycle");
    EXPECT_GT(ratio, 0.7) << row.at("hand") << " " << row.at("radius_mm");
    EXPECT_LT(ratio, 1.4) << row.at("hand") << " " << row.at("radius_mm");
  }
}

// One test, since each runs in a program of its own and would make the chart again.
TEST(ChartStability, RepeatsAndFindsTheDefaultQuiet) {
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
  const std::vector<CsvRow> rows = read_csv(scratch / "first" / "stability_stiffness.csv");
  expect_eigenvalue(rows);
  expect_default_quiet(rows);
  expect_ungoverned_fails_when_slow(rows);
  expect_filter_never_better(rows);
  expect_remedies(read_csv(scratch / "first" / "stability_cases.csv"));
  expect_volume(scratch / "first");
}

}  // namespace
}  // namespace argil::test
