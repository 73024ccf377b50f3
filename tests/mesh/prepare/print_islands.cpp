// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/print_islands.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/profile_solids.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::ball_mesh;
using test::box_mesh;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kLayer = 0.2;

TEST(PrintIslands, AreNoneInWhatStandsOnTheBed) {
  EXPECT_THAT(print_islands(box_mesh({10.0, 10.0, 10.0}), kLayer), IsEmpty());
  EXPECT_THAT(print_islands(ball_mesh(10.0, 4), kLayer), IsEmpty());
  EXPECT_THAT(print_islands(TriangleMesh{}, kLayer), IsEmpty());
}

TEST(PrintIslands, HaveThePlaceAndAreaOfABoxThatHangsInTheAir) {
  const TriangleMesh both =
      test::joined(box_mesh({20.0, 20.0, 4.0}), box_mesh({6.0, 5.0, 2.0}, {0.0, 0.0, 11.0}));
  const auto islands = print_islands(both, kLayer);
  ASSERT_THAT(islands, SizeIs(1));
  EXPECT_DOUBLE_EQ(islands[0].at_mm.z, 10.0);
  EXPECT_NEAR(islands[0].area_mm2, 30.0, 1e-9);
  EXPECT_TRUE(std::isinf(islands[0].free_mm));
}

/// An upright ring on a plate: its hole's ceiling is no island, as both sides hold it.
TEST(PrintIslands, AreNoneInAnUprightRing) {
  TriangleMesh ring = test::torus_mesh(10.0, 3.0, 48, 24);
  for (Vec3& p : ring.positions) p = {p.x, -p.z, p.y};
  EXPECT_THAT(print_islands(ring, kLayer), IsEmpty());
}

/// Of a table's legs the one that does not reach the bed.
TEST(PrintIslands, AreTheShorterOfTwoLegs) {
  const TriangleMesh table = test::extruded({{0, 0, 0},
                                             {4, 0, 0},
                                             {4, 0, 20},
                                             {16, 0, 20},
                                             {16, 0, 3},
                                             {20, 0, 3},
                                             {20, 0, 24},
                                             {0, 0, 24}},
                                            10.0);
  ASSERT_GT(signed_volume(table), 0.0);
  const auto islands = print_islands(table, kLayer);
  ASSERT_THAT(islands, SizeIs(1));
  EXPECT_DOUBLE_EQ(islands[0].at_mm.z, 3.0);
  EXPECT_NEAR(islands[0].area_mm2, 40.0, 1e-9);
  EXPECT_NEAR(islands[0].free_mm, 17.0, 1e-9);
}

TEST(PrintIslands, HangFromTheCeilingOfACavityButAreNotItsFloor) {
  const TriangleMesh hollow =
      test::joined(box_mesh({20.0, 20.0, 20.0}), test::inside_out(box_mesh({12.0, 12.0, 12.0})));
  EXPECT_THAT(print_islands(hollow, kLayer), IsEmpty());
  const TriangleMesh loose = test::joined(hollow, ball_mesh(3.0, 4));
  const auto islands = print_islands(loose, kLayer);
  ASSERT_THAT(islands, SizeIs(1));
  EXPECT_NEAR(islands[0].at_mm.z, -3.0, 1e-9);
  // The cap of a ball, one layer high.
  EXPECT_NEAR(islands[0].area_mm2, std::numbers::pi * (9.0 - 2.8 * 2.8), 0.15);
}

TEST(PrintIslands, IgnoreBumpsLowerThanALayer) {
  // A bridge with two teeth in its ceiling, of 0.1 and of 0.5 mm.
  const TriangleMesh bridge = test::extruded({{0, 0, 0},
                                              {4, 0, 0},
                                              {4, 0, 9},
                                              {6, 0, 9},
                                              {6, 0, 8.9},
                                              {7, 0, 8.9},
                                              {7, 0, 9},
                                              {10, 0, 9},
                                              {10, 0, 8.5},
                                              {11, 0, 8.5},
                                              {11, 0, 9},
                                              {16, 0, 9},
                                              {16, 0, 0},
                                              {20, 0, 0},
                                              {20, 0, 12},
                                              {0, 0, 12}},
                                             10.0);
  const auto islands = print_islands(bridge, kLayer);
  ASSERT_THAT(islands, SizeIs(1));
  EXPECT_DOUBLE_EQ(islands[0].at_mm.z, 8.5);
  EXPECT_THAT(print_islands(bridge, 0.05), SizeIs(2));
}

}  // namespace
}  // namespace argil::mesh
