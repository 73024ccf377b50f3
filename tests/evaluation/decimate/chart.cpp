// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart decimate: that it repeats, and that at the same count ours misses least of the clay.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "evaluation/csv.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

std::string decimate_label(const CsvRow& row) {
  return row.at("piece") + ", " + row.at("decimator") + " to " + row.at("share");
}

/// Rows by piece and share, then by who made them.
std::map<std::string, std::map<std::string, CsvRow>> by_count(const std::vector<CsvRow>& rows) {
  std::map<std::string, std::map<std::string, CsvRow>> found;
  for (const CsvRow& row : rows) {
    found[row.at("piece") + ", " + row.at("share")][row.at("decimator")] = row;
  }
  return found;
}

void expect_least_error(const std::map<std::string, CsvRow>& rows) {
  ASSERT_EQ(rows.size(), 3U);
  const CsvRow& ours = rows.at("argil");
  EXPECT_EQ(ours.at("printable"), "yes");
  for (const char* name : {"openmesh", "cgal"}) {
    SCOPED_TRACE(name);
    const CsvRow& other = rows.at(name);
    EXPECT_LE(csv_value(ours, "triangles"), csv_value(other, "triangles"));
    for (const char* mean : {"mean_to_field", "mean_to_mesh"}) {
      EXPECT_LE(csv_value(ours, mean), csv_value(other, mean)) << mean;
    }
  }
}

/// All reach the count asked, and ours misses least.
void expect_decimate_rows(const std::vector<CsvRow>& rows) {
  std::map<std::string, double> whole;
  for (const CsvRow& row : rows) {
    SCOPED_TRACE(decimate_label(row));
    if (row.at("decimator") == "none") {
      whole[row.at("piece")] = csv_value(row, "triangles");
      continue;
    }
    EXPECT_GT(csv_value(row, "cpu_s"), 0.0);
    // Rounded to an even one.
    const double asked = csv_value(row, "share") * whole.at(row.at("piece"));
    EXPECT_NEAR(csv_value(row, "triangles"), asked, 1.0);
  }
  EXPECT_EQ(whole.size(), 2U);
  for (const auto& [count, made] : by_count(rows)) {
    if (count.ends_with(", 1")) continue;  // the whole surface
    SCOPED_TRACE(count);
    expect_least_error(made);
  }
}

TEST(ChartDecimate, RepeatsAndOursMissesLeastAtTheSameCount) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "decimate", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json report = make("first");
  // Usually it is cheaper charts' part to repeat.
  const bool is_repeated = effort(false, true);
  if (is_repeated) make("second");
  const std::vector<CsvRow> rows = read_csv(scratch / "first" / "decimate.csv").rows;
  const std::vector<CsvRow> again =
      is_repeated ? read_csv(scratch / "second" / "decimate.csv").rows : rows;
  ASSERT_EQ(rows.size(), again.size());
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  EXPECT_THAT(report["skipped"], testing::IsEmpty());
  for (const nlohmann::json& file : report["files"]) {
    EXPECT_FALSE(text_of(file.get<std::string>()).empty()) << file;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("hash"), again[i].at("hash")) << decimate_label(rows[i]);
  }
  expect_decimate_rows(rows);
}

}  // namespace
}  // namespace argil::test
