// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/liquid_pockets.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/profile_solids.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::box_mesh;
using testing::IsEmpty;
using testing::SizeIs;

const Progress kFloodProgress;

std::vector<LiquidPocket> pockets_of(const TriangleMesh& mesh, double pitch_mm = 0.25) {
  return liquid_pockets(mesh, {pitch_mm, 10.0}, Pace(kFloodProgress, "drain"));
}

TriangleMesh upside_down(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = {p.x, -p.y, -p.z};
  return mesh;
}

TEST(LiquidPockets, AreNoneInSolids) {
  EXPECT_THAT(pockets_of(box_mesh({20.0, 20.0, 20.0})), IsEmpty());
  EXPECT_THAT(pockets_of(test::ball_mesh(10.0, 4)), IsEmpty());
  EXPECT_THAT(pockets_of(TriangleMesh{}), IsEmpty());
}

TEST(LiquidPockets, HaveTheVolumeOfACupToItsRim) {
  const auto found = pockets_of(test::cup());
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].closed);
  // The ring's 96 sides take 0.07 % off; the lines are a quarter of a millimetre apart.
  EXPECT_NEAR(found[0].volume_mm3, std::numbers::pi * 18.0 * 18.0 * 28.0, 300.0);
  EXPECT_NEAR(found[0].lowest_mm.z, 2.0, 1e-9);
  EXPECT_NEAR(found[0].highest_mm.z, 30.0, 1e-9);
  EXPECT_LT(std::hypot(found[0].lowest_mm.x, found[0].lowest_mm.y), 0.5);  // its floor's middle
}

TEST(LiquidPockets, AreNoneInACupUpsideDown) {
  EXPECT_THAT(pockets_of(upside_down(test::cup())), IsEmpty());
}

TEST(LiquidPockets, StandToTheHeightOfAHoleInTheWall) {
  // A tray of 20 x 20 x 10 inside; its wall in front has a slot from z = 5 upward.
  const TriangleMesh tray =
      test::joined(test::extruded({{-12, 0, 0},
                                   {12, 0, 0},
                                   {12, 0, 12},
                                   {10, 0, 12},
                                   {10, 0, 2},
                                   {-10, 0, 2},
                                   {-10, 0, 12},
                                   {-12, 0, 12}},
                                  20.0),
                   test::joined(box_mesh({24.0, 2.0, 12.0}, {0.0, 11.0, 6.0}),
                                box_mesh({24.0, 2.0, 5.0}, {0.0, -11.0, 2.5})));
  const auto found = pockets_of(tray);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].volume_mm3, 20.0 * 20.0 * 3.0, 40.0);
  EXPECT_NEAR(found[0].highest_mm.z, 5.0, 1e-9);
}

TEST(LiquidPockets, AreClosedWhereThereIsNoWayOut) {
  const TriangleMesh hollow =
      test::joined(box_mesh({20.0, 20.0, 20.0}), test::inside_out(test::ball_mesh(8.0, 5)));
  const auto found = pockets_of(hollow);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_TRUE(found[0].closed);
  EXPECT_NEAR(found[0].volume_mm3, 4.0 / 3.0 * std::numbers::pi * 512.0, 15.0);
  EXPECT_NEAR(found[0].lowest_mm.z, -8.0, 0.05);
  EXPECT_NEAR(found[0].highest_mm.z, 8.0, 0.05);
}

TEST(LiquidPockets, StopWhenAsked) {
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(liquid_pockets(test::cup(), {}, Pace(stop, "drain")), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
