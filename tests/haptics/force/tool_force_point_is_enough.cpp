// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "argil/haptics/force/tool_force.h"

#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

TEST(PointIsEnough, HoldsItsOnePercent) {
  const Vec3 n = normalized(Vec3{1, 2, 3});
  int enough = 0;
  for (const double e : {1.0, 1.5, 2.0, 4.0, 8.0}) {
    ForceMaterial material;
    material.exponent = e;
    for (int place = 0; place < 29; ++place) {
      const double phi = -12.0 + 0.7 * place;
      for (int size = 0; size < 10; ++size) {
        const double radius = 0.1 * std::pow(1.5, size);
        if (!point_is_enough(radius, phi, material)) continue;
        ++enough;
        const ForceTool tool = fields::ball_tool(radius, phi * n);
        const auto window =
            fields::sampled(fields::plane(n), tool.position_mm, 2.0 * radius, radius / 5.0);
        const Vec3 point = point_force(window.view, tool, material).contact_n;
        const Vec3 volume = volume_force(window.view, tool, material, ForceLaw::energy).contact_n;
        EXPECT_LE(length(point - volume), 0.0105 * length(volume))
            << e << ' ' << phi << ' ' << radius;
      }
    }
  }
  EXPECT_GT(enough, 100);
}

TEST(PointIsEnough, FollowsTheRadiusOfTheTheory) {
  ForceMaterial material;  // e = 2: 0.22 of the skin on the surface
  material.clamp_ratio = 4.0;
  EXPECT_TRUE(point_is_enough(0.22 * material.skin_mm, 0.0, material));
  EXPECT_FALSE(point_is_enough(0.23 * material.skin_mm, 0.0, material));
  EXPECT_FALSE(point_is_enough(0.1, material.skin_mm, material));
}

}  // namespace
}  // namespace argil::haptics
