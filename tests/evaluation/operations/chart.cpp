// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart operations: that every method is there or named, and how exact each is. Never how
// long anything takes.
#include <filesystem>
#include <map>
#include <string>
#include <utility>
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

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const std::vector<std::string> kLevelSetTasks{"import", "offset +2", "offset -2", "offset -8",
                                              "union",  "resample",  "hollow"};

/// By body, operation and method.
using OperationRows = std::map<std::string, CsvRow>;

std::string operation_label(const std::string& body, const std::string& operation,
                            const std::string& method) {
  return body + ", " + operation + ", " + method;
}

OperationRows operation_rows(const std::filesystem::path& folder) {
  OperationRows rows;
  for (CsvRow& row : read_csv(folder / "operations.csv").rows) {
    const std::string label =
        operation_label(row.at("body"), row.at("operation"), row.at("method"));
    EXPECT_GT(csv_value(row, "cpu_s"), 0.0) << label;
    EXPECT_LE(csv_value(row, "least_cpu_s"), csv_value(row, "most_cpu_s")) << label;
    EXPECT_GE(csv_value(row, "max"), csv_value(row, "rms")) << label;
    rows[label] = std::move(row);
  }
  return rows;
}

Ended tiny_operations(const std::filesystem::path& folder) {
  return run_argil({"chart", "operations", "--quick", "-o", folder.string(), "--json"});
}

/// Errors that are not to be exceeded, in finest voxels.
struct OperationBound {
  const char* column;
  double ball;
  double block;
};

/// Of Argil with its usual tolerance of 0.1 voxel: that, and edges that are cut off.
void expect_ours_exact(const OperationRows& rows) {
  for (const std::string& task : kLevelSetTasks) {
    for (const auto& [column, ball, block] :
         {OperationBound{"rms", 0.05, 0.07}, OperationBound{"p99", 0.15, 0.35},
          OperationBound{"max", 0.25, 1.0}}) {
      SCOPED_TRACE(task + ", " + column);
      EXPECT_LE(csv_value(rows.at(operation_label("wavy ball", task, "argil")), column), ball);
      EXPECT_LE(csv_value(rows.at(operation_label("turned block", task, "argil")), column), block);
    }
  }
  for (const char* task : {"import", "resample", "hollow", "union"}) {
    SCOPED_TRACE(task);
    EXPECT_LE(csv_value(rows.at(operation_label("wavy ball", task, "argil")), "missed"), 0.25);
  }
}

/// With the least tolerance ours is nearer than level sets of the same voxel.
void expect_fine_ahead(const OperationRows& rows) {
  for (const std::string& task : kLevelSetTasks) {
    for (const char* body : {"wavy ball", "turned block"}) {
      SCOPED_TRACE(operation_label(body, task, "argil_fine"));
      EXPECT_LT(csv_value(rows.at(operation_label(body, task, "argil_fine")), "rms"),
                csv_value(rows.at(operation_label(body, task, "openvdb")), "rms"));
    }
  }
}

/// What the truth of each row is measured by is right: rivals have the errors that they must have.
void expect_rivals_as_known(const OperationRows& rows) {
  for (const char* body : {"wavy ball", "turned block"}) {
    SCOPED_TRACE(body);
    // Corefinement keeps the vertices that it does not remove.
    EXPECT_LT(csv_value(rows.at(operation_label(body, "union", "cgal")), "max"), 1e-9);
    EXPECT_LT(csv_value(rows.at(operation_label(body, "union", "cgal")), "missed"), 1e-9);
    // A wrap lies a thirtieth of a voxel outside.
    EXPECT_NEAR(csv_value(rows.at(operation_label(body, "import", "cgal")), "p50"), 1.0 / 30.0,
                0.005);
    for (const std::string& task : kLevelSetTasks) {
      EXPECT_LT(csv_value(rows.at(operation_label(body, task, "openvdb")), "rms"), 0.15) << task;
    }
  }
}

/// Of what is skipped, that it is Blender, and meshoptimizer where Argil was built without it: then
/// as many rows are left out as there are bodies.
std::size_t expect_named_where_it_is_not_there(const nlohmann::json& skipped,
                                               const OperationRows& rows) {
  const auto lines = skipped.get<std::vector<std::string>>();
  if (rows.count(operation_label("wavy ball", "decimate", "meshoptimizer")) == 1) {
    EXPECT_THAT(lines, ElementsAre(HasSubstr("blender is not installed")));
    return 0;
  }
  EXPECT_THAT(lines, ElementsAre(HasSubstr("blender is not installed"),
                                 HasSubstr("built without meshoptimizer"),
                                 HasSubstr("built without meshoptimizer")));
  return 2;
}

TEST(ChartOperations, OursStaysWithinItsBoundsAndRivalsAreThere) {
  const ScratchFolder scratch;
  const Setting path("PATH", (scratch / "nothing").string());
  const Ended run = tiny_operations(scratch / "charts");
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json report = run.json();
  const OperationRows rows = operation_rows(scratch / "charts");
  const std::size_t left_out = expect_named_where_it_is_not_there(report["skipped"], rows);
  // Three with level sets, CGAL's wrap and union, four that remove triangles, two files.
  EXPECT_THAT(rows, SizeIs(2 * (3 * kLevelSetTasks.size() + 2 + 4 + 2) - left_out));
  EXPECT_EQ(rows.size(), report["rows"].get<std::size_t>());
  expect_ours_exact(rows);
  expect_fine_ahead(rows);
  expect_rivals_as_known(rows);
  for (const char* body : {"wavy ball", "turned block"}) {
    const double stl = csv_value(rows.at(operation_label(body, "export stl", "argil")), "max");
    EXPECT_EQ(stl, csv_value(rows.at(operation_label(body, "export 3mf", "argil")), "max"));
    EXPECT_LE(stl, 0.5);
  }
}

TEST(ChartOperations, NamesASizeThatCannotBe) {
  const ScratchFolder scratch;
  for (const char* sizes : {"0", "11", ".1,,2", "x"}) {
    const Ended run =
        run_argil({"chart", "operations", "--sizes", sizes, "-o", (scratch / "charts").string()});
    EXPECT_EQ(run.status, 2) << sizes;
    EXPECT_THAT(run.err, HasSubstr("--sizes")) << sizes;
  }
}

TEST(ChartOperationsClient, MeasuresBlendersRemesherAndUnion) {
  ARGIL_CLIENT_OR_SKIP("blender");
  const ScratchFolder scratch;
  const Ended run = tiny_operations(scratch / "charts");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.json()["skipped"].empty());
  const OperationRows rows = operation_rows(scratch / "charts");
  for (const char* body : {"wavy ball", "turned block"}) {
    SCOPED_TRACE(body);
    // Its vertices are on the triangles, but for those around edges.
    EXPECT_LT(csv_value(rows.at(operation_label(body, "import", "blender")), "rms"), 0.05);
    // In floats.
    EXPECT_LT(csv_value(rows.at(operation_label(body, "union", "blender")), "max"), 1e-4);
    EXPECT_EQ(csv_value(rows.at(operation_label(body, "union", "blender")), "vertices"),
              csv_value(rows.at(operation_label(body, "union", "cgal")), "vertices"));
  }
}

}  // namespace
}  // namespace argil::test
