// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/closed_force.h"

#include <gtest/gtest.h>

#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

void expect_same_force(const ForceResult& closed, const ForceResult& summed, double radius) {
  const double force = length(closed.contact_n);
  EXPECT_LE(length(closed.contact_n - summed.contact_n), 1e-6 * force + 1e-9);
  EXPECT_LE(length(closed.contact_nmm - summed.contact_nmm), 1e-6 * force * radius + 1e-9);
  EXPECT_NEAR(closed.energy_nmm, summed.energy_nmm, 1e-6 * closed.energy_nmm + 1e-9);
}

TEST(ClosedForce, OfAPlaneIsTheConvergedSum) {
  const Vec3 n = normalized(Vec3{1, 2, 3});
  for (const double e : {1.0, 2.0, 2.5, 4.0}) {
    ForceMaterial material;
    material.exponent = e;
    for (const double height : {-6.0, 0.0, 7.5}) {
      ForceTool tool = ball_tool(8.0, (2.0 + height) * n);
      expect_same_force(plane_force(n, 2.0, tool, material),
                        force_at(plane(n, 2.0), tool, 40, material, ForceLaw::energy), 8.0);
      tool.radii_mm = {8.0, 4.0, 3.0};
      tool.orientation = normalized(Quat{0.8, 0.3, -0.4, 0.2});
      expect_same_force(plane_force(n, 2.0, tool, material),
                        force_at(plane(n, 2.0), tool, 24, material, ForceLaw::energy), 8.0);
    }
  }
}

TEST(ClosedForce, OfABallIsTheConvergedSum) {
  const Vec3 center{3, -2, 5};
  for (const double e : {1.0, 2.0, 4.0}) {
    ForceMaterial material;
    material.exponent = e;
    for (const double height : {-10.0, 0.0, 7.5}) {
      const ForceTool tool =
          ball_tool(8.0, center + (24.0 + height) * normalized(Vec3{-1, 2, 0.5}));
      expect_same_force(ball_force(center, 24.0, tool, material),
                        force_at(ball(24.0, center), tool, 40, material, ForceLaw::energy), 8.0);
    }
  }
}

TEST(ClosedForce, IsNoughtOutsideTheSkin) {
  const ForceTool tool = ball_tool(2.0, {0, 0, 8.0 + 2.0 * kKernelSupport});
  EXPECT_EQ(plane_force({0, 0, 1}, 0.0, tool, {}).contact_n, Vec3{});
}

}  // namespace
}  // namespace argil::haptics
