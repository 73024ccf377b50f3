// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart normals: that its errors repeat, and that they are those of docs/lab.md.
#include <filesystem>
#include <fstream>
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

nlohmann::json make_normals(const std::filesystem::path& folder) {
  const Ended run = run_argil({"chart", "normals", "--quick", "-o", folder.string(), "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  return run.json();
}

/// By "strategy setting depth".
std::map<std::string, CsvRow> normals_by_name(const std::vector<CsvRow>& rows) {
  std::map<std::string, CsvRow> named;
  for (const CsvRow& row : rows) {
    named[row.at("strategy") + " " + row.at("setting") + " " + row.at("depth_mm")] = row;
  }
  return named;
}

/// The hash is of what does not depend on the machine's speed.
TEST(ChartNormals, RepeatsButForItsTimes) {
  const ScratchFolder scratch;
  const nlohmann::json report = make_normals(scratch / "first");
  make_normals(scratch / "second");
  const CsvFile first = read_csv(scratch / "first" / "normals.csv");
  const CsvFile second = read_csv(scratch / "second" / "normals.csv");
  EXPECT_EQ(first.comment, second.comment);
  EXPECT_THAT(first.comment, testing::HasSubstr("hash "));
  EXPECT_EQ(first.rows.size(), report["rows"].get<std::size_t>());
  ASSERT_EQ(first.rows.size(), second.rows.size());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_GT(csv_value(first.rows[i], "ns"), 0.0) << i;
    for (const auto& [column, value] : first.rows[i]) {
      if (column == "ns") continue;
      EXPECT_EQ(value, second.rows[i].at(column)) << i << " " << column;
    }
  }
  for (const nlohmann::json& file : report["files"]) {
    EXPECT_FALSE(text_of(file.get<std::string>()).empty()) << file;
  }
}

TEST(ChartNormals, TellsWhatEachStrategyMisses) {
  const ScratchFolder scratch;
  make_normals(scratch / "charts");
  const auto rows = normals_by_name(read_csv(scratch / "charts" / "normals.csv").rows);
  const auto value = [&rows](const std::string& name, const char* column) {
    const auto found = rows.find(name);
    EXPECT_NE(found, rows.end()) << name;
    return found == rows.end() ? -1.0 : csv_value(found->second, column);
  };
  const auto angle = [&value](const std::string& name) { return value(name, "angle_rms_deg"); };
  // On the surface: the analytic normal is exact, tables and differences are of their orders.
  EXPECT_EQ(angle("analytic 0 0"), 0.0);
  EXPECT_NEAR(angle("table_nearest 1 0"), 1.2, 0.1);
  EXPECT_NEAR(angle("table_nearest 2 0") / angle("table_nearest 0.5 0"), 4.0, 0.3);
  EXPECT_NEAR(angle("table_bilinear 2 0") / angle("table_bilinear 0.5 0"), 16.0, 1.5);
  EXPECT_NEAR(angle("differences_ahead 1 0") / angle("differences_ahead 0.1 0"), 10.0, 1.0);
  EXPECT_NEAR(angle("differences_central 1 0") / angle("differences_central 0.1 0"), 100.0, 10.0);
  EXPECT_GT(angle("z 0 0"), 20.0);
  // Below it no normal straight above is right, whatever it is made of; steps and network are.
  const double above = angle("analytic 0 3");
  EXPECT_GT(above, 2.0);
  EXPECT_NEAR(angle("table_bilinear 0.5 3"), above, 0.05 * above);
  EXPECT_NEAR(angle("differences_central 0.1 3"), above, 0.05 * above);
  for (const char* steps : {"analytic 1 3", "analytic 2 3", "analytic 3 3", "analytic 4 3"}) {
    EXPECT_LT(angle(steps), 0.4 * above) << steps;
  }
  EXPECT_LT(angle("network 0 3"), 0.05 * above);
  EXPECT_LT(value("network 0 3", "distance_rms_mm"),
            0.15 * value("analytic 0 3", "distance_rms_mm"));
  // Normals of three doubles each; floats, the square of weights twice.
  EXPECT_EQ(value("table_nearest 1 0", "bytes"), 161.0 * 161.0 * 24.0);
  EXPECT_EQ(value("analytic 0 0", "bytes"), 0.0);
  EXPECT_EQ(value("network 0 0", "bytes"), 4.0 * (3 * 16 + 16 + 2 * 256 + 16 + 16 + 1));
}

TEST(ChartNormals, RefusesAFolderThatIsAFile) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "charts") << "a file";
  const Ended run = run_argil({"chart", "normals", "--quick", "-o", (scratch / "charts").string()});
  EXPECT_EQ(run.status, 5);
  EXPECT_THAT(run.err, testing::HasSubstr("cannot make the folder"));
}

}  // namespace
}  // namespace argil::test
