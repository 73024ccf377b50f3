// SPDX-License-Identifier: GPL-3.0-or-later
// A project with several pieces as Blender shows it.
#include <gtest/gtest.h>

#include "argil/io/project_file.h"

#include "support/blender_boxes.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

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
  const std::map<std::string, Box3> boxes = test::blender_boxes(folder / "p.vdb");
  for (std::size_t n = 0; n < 2; ++n) {
    const PieceLook& look = sculpture.look(n);
    const auto found = boxes.find(look.name + "/surface_0");
    ASSERT_NE(found, boxes.end()) << look.name;
    const Box3& shown = found->second;
    const Box3 wanted = test::placed_surface(sculpture, n);
    // Its mesh of voxels rounds corners off.
    EXPECT_LT(length(shown.min - wanted.min), 0.4) << look.name;
    EXPECT_LT(length(shown.max - wanted.max), 0.4) << look.name;
  }
}

}  // namespace
}  // namespace argil::io
