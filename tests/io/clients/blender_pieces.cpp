// SPDX-License-Identifier: GPL-3.0-or-later
// A project with several pieces as Blender shows it.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/project_file.h"

#include "support/clients.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

/// The box that Blender printed for a grid; empty where it printed none.
Box3 box_in(const std::string& output, const std::string& grid) {
  const std::size_t at = output.find(grid + ": ");
  if (at == std::string::npos) return {};
  std::istringstream numbers(output.substr(at + grid.size() + 2));
  Box3 box;
  numbers >> box.min.x >> box.min.y >> box.min.z >> box.max.x >> box.max.y >> box.max.z;
  return numbers ? box : Box3{};
}

TEST(BlenderClient, ShowsPiecesWhereTheyStand) {
  ARGIL_CLIENT_OR_SKIP("blender");
  // Small enough that the finest level is everywhere.
  Sculpture sculpture(Clay::ball(3.0, {.voxel_mm = 0.25, .tolerance_voxels = 0.01}).value(),
                      {.name = "Ball"});
  AddPiece add;
  add.look = {.name = "Turned block", .placement = {{20.0, -3.0, 1.5}, {0.6, 0.0, 0.0, 0.8}}};
  add.clay = std::make_shared<const Clay>(
      Clay::block({8.0, 3.0, 2.0}, {.voxel_mm = 0.25, .tolerance_voxels = 0.01}).value());
  ASSERT_TRUE(sculpture.apply(add));
  const test::ScratchFolder folder;
  ASSERT_TRUE(save_sculpture(folder / "p.vdb", sculpture));
  const test::ProgramRun run =
      test::run_program({"blender", "-b", "--factory-startup", "-noaudio", "--python",
                         "tests/io/clients/blender_pieces.py", "--", (folder / "p.vdb").string()});
  ASSERT_EQ(run.status, 0) << run.output;
  for (std::size_t n = 0; n < 2; ++n) {
    const PieceLook& look = sculpture.look(n);
    const Box3 shown = box_in(run.output, look.name + "/surface_0");
    ASSERT_FALSE(shown.empty()) << run.output;
    Box3 wanted;
    for (const Vec3& p : extract_surface(sculpture.clay(n)).positions) {
      wanted.include(placed(look.placement, p));
    }
    // Its mesh of voxels rounds corners off.
    EXPECT_LT(length(shown.min - wanted.min), 0.4) << look.name;
    EXPECT_LT(length(shown.max - wanted.max), 0.4) << look.name;
  }
}

}  // namespace
}  // namespace argil::io
