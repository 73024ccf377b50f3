// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart edits: that every row did what it says, how exact our strokes are, and what is left
// out by name. Never how long anything takes.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
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

std::string edit_label(const CsvRow& row) {
  return row.at("editor") + ", " + row.at("tool") + ", " + row.at("covered");
}

Ended quick_edits(const std::filesystem::path& folder, const RunOptions& options = {}) {
  return run_argil({"chart", "edits", "--quick", "-o", folder.string(), "--json"}, options);
}

/// What holds for all rows, whoever made them.
void expect_moved(const CsvRow& row) {
  // As many vertices as asked for, of a surface whose vertices lie as they like.
  EXPECT_NEAR(csv_value(row, "covered_vertices") / csv_value(row, "covered"), 1.0, 0.25);
  EXPECT_GT(csv_value(row, "moved_mm"), 0.05 * csv_value(row, "voxel_mm"));
  // Grab pulls by a radius, everything else moves less.
  EXPECT_LT(csv_value(row, "moved_mm"), 1.1 * csv_value(row, "radius_mm"));
  EXPECT_GT(csv_value(row, "stroke_wall_ms"), 0.0);
}

/// A stroke lies near itself on finer edges, and where the tool is a solid, near that.
void expect_exact(const CsvRow& row) {
  // Smoothing averages over a tool's own level, which on so coarse a clay is not the same for both.
  EXPECT_LT(csv_value(row, "to_finer_mean"), row.at("tool") == "smooth" ? 0.15 : 0.1);
  EXPECT_LT(csv_value(row, "to_finer_p99"), 0.5);
  EXPECT_LE(csv_value(row, "to_finer_mean"), csv_value(row, "to_finer_p99"));
  EXPECT_LE(csv_value(row, "to_finer_p99"), csv_value(row, "to_finer_max"));
  const bool is_stamped = row.at("tool") == "add" || row.at("tool") == "carve";
  EXPECT_EQ(row.at("to_swept_mean").empty(), !is_stamped);
  if (is_stamped) {
    EXPECT_LT(csv_value(row, "to_swept_mean"), 0.1);
    EXPECT_LT(csv_value(row, "to_swept_p99"), 0.5);
  }
}

/// Tools by editor.
std::map<std::string, std::set<std::string>> tools_of(const std::vector<CsvRow>& rows) {
  std::map<std::string, std::set<std::string>> tools;
  for (const CsvRow& row : rows) tools[row.at("editor")].insert(row.at("tool"));
  return tools;
}

void expect_argil_rows(const std::vector<CsvRow>& rows) {
  EXPECT_EQ(tools_of(rows)["argil"],
            (std::set<std::string>{"add", "carve", "inflate", "smooth", "crease", "grab"}));
  int proven = 0;
  for (const CsvRow& row : rows) {
    SCOPED_TRACE(edit_label(row));
    expect_moved(row);
    if (row.at("editor") != "argil" || row.at("to_finer_mean").empty()) continue;
    expect_exact(row);
    ++proven;
  }
  EXPECT_EQ(proven, 6);
}

/// A PATH by which the first start of Blender is a crash, as happens with real ones.
std::string with_crashing_blender(const std::filesystem::path& folder) {
  const std::string crashed = "'" + (folder / "crashed").string() + "'";
  std::filesystem::create_directory(folder / "bin");
  const std::filesystem::path program = folder / "bin" / "blender";
  std::ofstream(program) << "#!/bin/sh\nif [ ! -e " << crashed << " ]; then : >" << crashed
                         << "; kill -SEGV $$; fi\nPATH=${PATH#*:} exec blender \"$@\"\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const char* before = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
  return (folder / "bin").string() + ":" + (before == nullptr ? "" : before);
}

TEST(ChartEdits, GoesWithoutBlenderAndSaysSo) {
  const ScratchFolder scratch;
  const Setting path("PATH", (scratch / "nothing").string());
  const Ended run = quick_edits(scratch / "charts");
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json report = run.json();
  EXPECT_THAT(
      report["skipped"].get<std::vector<std::string>>(),
      testing::IsSupersetOf({HasSubstr("blender is not installed"), HasSubstr("SculptGL")}));
  const CsvFile table = read_csv(scratch / "charts" / "edits.csv");
  EXPECT_EQ(table.rows.size(), report["rows"].get<std::size_t>());
  EXPECT_EQ(tools_of(table.rows).size(), 1U);
  expect_argil_rows(table.rows);
}

TEST(ChartEditsClient, SculptsTheSameBallInBlenderThoughThatCrashesOnce) {
  ARGIL_CLIENT_OR_SKIP("blender");
  ARGIL_CLIENT_OR_SKIP("Xvfb");
  const ScratchFolder scratch;
  const std::string path = with_crashing_blender(scratch.path());
  const Setting crashes("PATH", path);
  const Ended run = quick_edits(scratch / "charts");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(scratch / "crashed"));
  const std::vector<CsvRow> rows = read_csv(scratch / "charts" / "edits.csv").rows;
  expect_argil_rows(rows);
  auto tools = tools_of(rows);
  const std::set<std::string> all{"SculptDraw", "Smooth", "Crease", "Grab"};
  for (const char* editor : {"blender", "blender_dyntopo", "blender_remesh"}) {
    EXPECT_EQ(tools[editor], all) << editor;
  }
  for (const CsvRow& row : rows) {
    if (row.at("editor") != "blender" || row.at("to_finer_mean").empty()) continue;
    SCOPED_TRACE(edit_label(row));
    // A mesh whose vertices follow the brush's law misses what lies between them; what smoothing
    // does depends on the mesh.
    EXPECT_LT(csv_value(row, "to_finer_mean"), row.at("brush") == "smooth" ? 0.2 : 0.05);
  }
  EXPECT_THAT(text_of((scratch / "charts" / "edits.gp").string()), HasSubstr("voxel remesher"));
}

TEST(ChartEditsClient, EndsBlenderWithAnInterrupt) {
  ARGIL_CLIENT_OR_SKIP("blender");
  ARGIL_CLIENT_OR_SKIP("Xvfb");
  const ScratchFolder scratch;
  // Where the program makes its own scratch folder, which tells when Blender runs.
  std::filesystem::create_directory(scratch / "tmp");
  const Setting place("TMPDIR", (scratch / "tmp").string());
  RunOptions options;
  const auto has_file = [&](const char* name) {
    for (const auto& folder : std::filesystem::directory_iterator(scratch / "tmp")) {
      if (std::filesystem::exists(folder.path() / name)) return true;
    }
    return false;
  };
  options.interrupt_when = [&] { return has_file("said"); };
  const Ended run = quick_edits(scratch / "charts", options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "tmp"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "charts" / "edits.csv"));
}

}  // namespace
}  // namespace argil::test
