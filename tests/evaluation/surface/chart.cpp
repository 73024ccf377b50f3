// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart surface: that it repeats, and that its errors are those of docs/surface.md.
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

std::string surface_label(const CsvRow& row) {
  return row.at("scene") + " " + row.at("mesher") + ", R/h " + row.at("detail");
}

void expect_ours(const CsvRow& row) {
  SCOPED_TRACE(surface_label(row));
  for (const char* column : {"error_max", "on_edge_error_max", "off_edge_error_max"}) {
    EXPECT_LE(csv_value(row, column), 0.01) << column;
  }
  EXPECT_LE(csv_value(row, "error_rms"), 0.001);
  EXPECT_GT(csv_value(row, "off_edge_share"), 0.05);
  EXPECT_GE(csv_value(row, "least_angle_deg"), 5.0);
  EXPECT_EQ(csv_value(row, "sliver_share"), 0.0);
  // Closed: a ball, a ring.
  const double euler = row.at("scene") == "ball" ? 2.0 : 0.0;
  EXPECT_EQ(csv_value(row, "triangles"), 2.0 * (csv_value(row, "vertices") - euler));
}

TEST(ChartSurface, RepeatsAndKeepsVerticesOnTheBody) {
  const ScratchFolder scratch;
  const auto make = [&](const std::string& name) {
    const Ended run =
        run_argil({"chart", "surface", "--quick", "-o", (scratch / name).string(), "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json report = make("first");
  make("second");
  const std::vector<CsvRow> rows = read_csv(scratch / "first" / "surface.csv").rows;
  const std::vector<CsvRow> again = read_csv(scratch / "second" / "surface.csv").rows;
  ASSERT_EQ(rows.size(), again.size());
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  for (const nlohmann::json& file : report["files"]) {
    EXPECT_FALSE(text_of(file.get<std::string>()).empty()) << file;
  }
  std::map<std::string, double> rms;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CsvRow& row = rows[i];
    EXPECT_EQ(row.at("hash"), again[i].at("hash")) << surface_label(row);
    EXPECT_GT(csv_value(row, "cpu_us_per_vertex"), 0.0) << surface_label(row);
    rms[surface_label(row)] = csv_value(row, "error_rms");
    if (row.at("mesher") == "argil") expect_ours(row);
    if (row.at("mesher") == "argil_adaptive") {
      EXPECT_LE(csv_value(row, "error_max_voxels"), 0.2) << surface_label(row);
    }
  }
  // Vertices lie nearer to the body than the means of cuts that volumeToMesh takes.
  for (const std::string scene : {"ball", "torus"}) {
    for (const std::string detail : {", R/h 16", ", R/h 32", ", R/h 64"}) {
      const auto of = [&](const char* mesher) {
        return rms.at(std::string(scene).append(mesher).append(detail));
      };
      EXPECT_LT(of(" argil"), of(" openvdb"));
    }
  }
}

}  // namespace
}  // namespace argil::test
