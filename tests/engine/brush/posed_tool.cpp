// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/posed_tool.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace argil {
namespace {

TEST(PosedTool, SweepsABallOfChangingSizeExactly) {
  Tool tool;
  tool.radii_mm = {2, 2, 2};
  tool.pressure_to_strength = 0.0;
  tool.pressure_to_size = 1.0;
  const DabPose from{{0, 0, 0}, {}, 0.4};
  const DabPose at{{3, 1, -2}, {}, 1.0};
  const PosedTool posed(tool, {from, at});
  for (double x = -4.0; x <= 8.0; x += 0.7) {
    for (double y = -4.0; y <= 5.0; y += 0.9) {
      const Vec3 p{x, y, 0.3 * x - y};
      double nearest = 1e9;
      for (int i = 0; i <= 20000; ++i) {
        const double t = i / 20000.0;
        nearest = std::min(nearest, length(p - t * at.position_mm) - 2.0 * (0.4 + 0.6 * t));
      }
      EXPECT_NEAR(posed.shrunk_distance(p), nearest, 1e-6);
    }
  }
}

TEST(PosedTool, SaysOfALeafWhatItSaysOfItsNodes) {
  constexpr double kVoxel = 0.1;
  Tool tool;
  tool.radii_mm = {0.9, 0.9, 0.9};
  const DabPose from{{0.1, 0.2, -0.3}, {}, 0.5};
  const DabPose on{{1.0, 0.4, 0.6}, {}, 0.5};
  Tool growing = tool;
  growing.pressure_to_size = 0.7;
  Tool longish = tool;
  longish.shape = Shape::ellipsoid;
  longish.radii_mm = {0.5, 0.7, 1.1};
  const std::array<PosedTool, 5> posed{PosedTool(tool, {from, on}), PosedTool(tool, {on, on}),
                                       PosedTool(growing, {from, {on.position_mm, {}, 1.0}}),
                                       PosedTool(longish, {from, on}),
                                       PosedTool(longish, {on, on})};
  for (const PosedTool& each : posed) {
    for (const Coord& origin : {Coord(0), Coord(-8, 0, 8), Coord(16, -16, -8)}) {
      LeafValues values;
      each.shrunk_distances(origin, kVoxel, values);
      for (std::size_t n = 0; n < values.size(); ++n) {
        EXPECT_NEAR(static_cast<double>(values[n]),
                    each.shrunk_distance(node_mm(node_of(origin, n), kVoxel)), 1e-6);
      }
    }
  }
}

TEST(PosedTool, IsTheLargerBallWhereOneHoldsTheOther) {
  Tool tool;
  tool.radii_mm = {2, 2, 2};
  tool.pressure_to_strength = 0.0;
  tool.pressure_to_size = 1.0;
  const PosedTool shrinks(tool, {{{0, 0, 0}, {}, 1.0}, {{0.5, 0, 0}, {}, 0.2}});
  const PosedTool grows(tool, {{{0, 0, 0}, {}, 0.2}, {{0.5, 0, 0}, {}, 1.0}});
  EXPECT_NEAR(shrinks.shrunk_distance({5, 0, 0}), 3.0, 1e-12);
  EXPECT_NEAR(grows.shrunk_distance({5, 0, 0}), 2.5, 1e-12);
}

TEST(PosedTool, SweepsOtherShapesToAThousandthOfTheirRadius) {
  Tool tool;
  tool.shape = Shape::ellipsoid;
  tool.radii_mm = {1.0, 2.0, 3.0};
  const Quat turn = normalized(Quat{0.9, 0.1, 0.2, 0.3});
  const PosedTool posed(tool, {{{0, 0, 0}, {}, 1.0}, {{0.5, 0.4, 0}, turn, 1.0}});
  for (double x = -2.0; x <= 3.0; x += 0.5) {
    double nearest = 1e9;
    for (int i = 0; i <= 2000; ++i) {
      const DabPose at = between({{0, 0, 0}, {}, 1.0}, {{0.5, 0.4, 0}, turn, 1.0}, i / 2000.0);
      nearest = std::min(nearest, ellipsoid_distance(rotate(conjugate(at.orientation),
                                                            Vec3{x, 1.5, 1.0} - at.position_mm),
                                                     tool.radii_mm));
    }
    EXPECT_NEAR(posed.shrunk_distance({x, 1.5, 1.0}), nearest, 2e-3);
  }
}

}  // namespace
}  // namespace argil
