// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart surface: that it repeats, that its errors are those of docs/surface.md, and what is
// left out by name. Never how long anything takes.
#include <cstdlib>
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
#include "support/clients.h"
#include "support/scratch.h"
#include "support/setting.h"

namespace argil::test {
namespace {

using testing::HasSubstr;

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

Ended quick_surface(const std::filesystem::path& folder, const RunOptions& options = {}) {
  return run_argil({"chart", "surface", "--quick", "-o", folder.string(), "--json"}, options);
}

/// A PATH on which `blender` is this shell script, and the rest is as it was.
std::string with_blender(const std::filesystem::path& folder, const std::string& script) {
  std::filesystem::create_directory(folder / "bin");
  const std::filesystem::path program = folder / "bin" / "blender";
  std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const char* before = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
  return (folder / "bin").string() + ":" + (before == nullptr ? "" : before);
}

std::vector<CsvRow> rows_by(const std::string& mesher, const std::filesystem::path& folder) {
  std::vector<CsvRow> rows = read_csv(folder / "surface.csv").rows;
  std::erase_if(rows, [&](const CsvRow& row) { return row.at("mesher") != mesher; });
  return rows;
}

TEST(ChartSurface, RepeatsAndKeepsVerticesOnTheBody) {
  const ScratchFolder scratch;
  const Setting path("PATH", (scratch / "nothing").string());
  const auto make = [&](const std::string& name) {
    const Ended run = quick_surface(scratch / name);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  };
  const nlohmann::json report = make("first");
  make("second");
  const std::vector<CsvRow> rows = read_csv(scratch / "first" / "surface.csv").rows;
  const std::vector<CsvRow> again = read_csv(scratch / "second" / "surface.csv").rows;
  ASSERT_EQ(rows.size(), again.size());
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  EXPECT_THAT(report["skipped"].get<std::vector<std::string>>(),
              testing::ElementsAre(HasSubstr("blender is not installed")));
  EXPECT_TRUE(rows_by("blender_remesh", scratch / "first").empty());
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

/// What each of two fakes leaves instead of an answer, and how the rows that lack are named.
TEST(ChartSurface, NamesWhatBlenderFailedAt) {
  const std::string answers = "for job; do :; done; cd \"${job%/*}\"; ";
  for (const auto& [script, reason] :
       {std::pair<std::string, const char*>{"echo no library of that name >&2; exit 1",
                                            "no library of that name"},
        {answers + "echo '{\"runs\": [[1, 1]]}' >answer; head -c 120 body.positions "
                   ">result.positions; head -c 1200 body.triangles >result.triangles",
         "its result is cut off"},
        {answers + "echo '{\"error\": \"no voxel is that small\"}' >answer",
         "no voxel is that small"}}) {
    const ScratchFolder scratch;
    const Setting path("PATH", with_blender(scratch.path(), script));
    const Ended run = quick_surface(scratch / "charts");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto skipped = run.json()["skipped"].get<std::vector<std::string>>();
    EXPECT_THAT(skipped, testing::SizeIs(6));
    EXPECT_THAT(skipped, testing::Each(HasSubstr(reason)));
    EXPECT_THAT(skipped, testing::Contains(HasSubstr("blender_remesh, torus, R/h 32")));
    EXPECT_TRUE(rows_by("blender_remesh", scratch / "charts").empty());
    EXPECT_EQ(rows_by("argil", scratch / "charts").size(), 6U);
  }
}

TEST(ChartSurfaceClient, MeasuresBlendersRemesher) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder scratch;
  const Ended run = quick_surface(scratch / "charts");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.json()["skipped"].empty());
  const std::vector<CsvRow> rows = rows_by("blender_remesh", scratch / "charts");
  ASSERT_EQ(rows.size(), 6U);
  for (const CsvRow& row : rows) {
    SCOPED_TRACE(surface_label(row));
    // On the flat triangles that it was given, which lie up to an eighth of h^2/R within the body
    // where their edges are a voxel, and a third across a cell.
    EXPECT_GT(csv_value(row, "error_rms"), 0.01);
    EXPECT_LT(csv_value(row, "error_max"), 0.5);
    // As many vertices as a surface has cells.
    const double radius = csv_value(row, "detail");
    EXPECT_GT(csv_value(row, "vertices"), 15.0 * radius * radius);
    EXPECT_LT(csv_value(row, "vertices"), 30.0 * radius * radius);
    EXPECT_GT(csv_value(row, "cpu_us_per_vertex"), 0.0);
    EXPECT_LT(csv_value(row, "sliver_share"), 0.1);
  }
  EXPECT_THAT(text_of((scratch / "charts" / "surface.gp").string()), HasSubstr("Blender"));
}

TEST(ChartSurfaceClient, EndsBlenderWithAnInterrupt) {
  ARGIL_CLIENT_OR_SKIP("sleep");
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "tmp");
  const std::string begun = (scratch / "begun").string();
  const Setting path("PATH", with_blender(scratch.path(), ": >'" + begun + "'; exec sleep 100"));
  const Setting place("TMPDIR", (scratch / "tmp").string());
  RunOptions options;
  options.interrupt_when = [&] { return std::filesystem::exists(begun); };
  const Ended run = quick_surface(scratch / "charts", options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "tmp"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "charts" / "surface.csv"));
}

}  // namespace
}  // namespace argil::test
