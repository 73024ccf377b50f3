// SPDX-License-Identifier: GPL-3.0-or-later
// Prepared pieces go through PrusaSlicer without a word: the owl of the examples and the Stanford
// bunny, for the filament and the resin printer.
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/import.h"
#include "argil/io/mesh_file.h"
#include "argil/io/prepared_mesh.h"
#include "argil/io/print_preparation.h"
#include "argil/io/printer_file.h"
#include "argil/io/stroke_script.h"

#include "support/clients.h"
#include "support/effort.h"
#include "support/models.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::ContainsRegex;
using testing::IsEmpty;
using testing::Not;

Clay bunny_to_print(const std::filesystem::path& file) {
  const auto read = read_prepared_mesh(file, {test::effort(40.0, 80.0), true});
  EXPECT_TRUE(read);
  ClayOptions options;
  options.voxel_mm = test::effort(0.5, 0.25);
  auto made = import_mesh(read.value().mesh, options);
  EXPECT_TRUE(made);
  return std::move(made.value().clay);
}

/// Its strokes, in voxels coarser than the script's.
Clay owl_to_print() {
  const auto script = read_stroke_script("examples/owl.strokes.jsonl");
  EXPECT_TRUE(script) << (script ? "" : script.error().message);
  const StartShape& start = script.value().start.value();
  ClayOptions options = start.options;
  options.voxel_mm = test::effort(0.7, 0.3);
  auto clay = Clay::ball(start.size_mm.x, options);
  EXPECT_TRUE(clay);
  for (const ScriptStep& step : script.value().steps) EXPECT_TRUE(apply_step(clay.value(), step));
  return std::move(clay).value();
}

void expect_sliced_for_resin(const std::filesystem::path& file) {
  const std::filesystem::path layers = file.parent_path() / "layers.sl1";
  const test::ProgramRun run =
      test::run_program({"prusa-slicer", "--loglevel", "2", "--printer-technology", "SLA",
                         "--export-sla", "-o", layers.string(), file.string()});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(layers));
  std::istringstream lines(run.output);
  for (std::string line; std::getline(lines, line);) {
    // Of supports, which its optimiser routes by chance: not of the mesh.
    if (line.find("support point") != std::string::npos) continue;
    EXPECT_THAT(line, Not(ContainsRegex("[Ww]arning|[Ee]rror|repair")));
  }
}

/// Prepares for both printers, hollow for resin, and slices each as such a printer needs it.
/// `is_for_resin`: nothing of the clay itself is too thin for that printer.
void expect_sliced(const Clay& clay, bool is_for_resin) {
  for (const std::string printer : {"filament", "resin"}) {
    SCOPED_TRACE(printer);
    PreparationOptions options;
    const auto profile = read_printer("printers/" + printer + ".json");
    ASSERT_TRUE(profile);
    options.printer = profile.value();
    options.wall_mm = printer == "resin" ? 3.0 : 0.0;
    const auto made = prepare_print(clay, options);
    ASSERT_TRUE(made) << (made ? "" : made.error().message);
    const PreparedPiece& piece = made.value().pieces.at(0);
    EXPECT_TRUE(piece.verdict.closed && piece.verdict.manifold && piece.verdict.outward);
    EXPECT_EQ(piece.verdict.self_intersections, 0);
    EXPECT_EQ(piece.verdict.cavities, 0);
    EXPECT_TRUE(printer != "resin" || made.value().is_printable() == is_for_resin);
    EXPECT_GT(made.value().chosen.footing_mm, 0.0);
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "piece.3mf";
    ASSERT_TRUE(write_mesh(file, piece.mesh));
    EXPECT_THAT(test::slicer_info(file).complaints, IsEmpty());
    if (printer == "resin") {
      expect_sliced_for_resin(file);
    } else {
      EXPECT_THAT(test::slicing_complaints(file), IsEmpty());
    }
  }
}

TEST(PreparedModelsClient, BunnyIsSlicedWithoutWarnings) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  ARGIL_MODEL_OR_SKIP(file, "stanford-bunny.obj");
  expect_sliced(bunny_to_print(file), true);
}

TEST(PreparedModelsClient, OwlIsSlicedWithoutWarnings) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  expect_sliced(owl_to_print(), false);  // flakes of its bark are too thin
}

}  // namespace
}  // namespace argil::io
