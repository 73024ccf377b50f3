// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/force/tool_force.h"

#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

using namespace fields;

// Rows (1) and (2) of docs/equations.md.

/// A ball of radius 32 voxels, sampled around the point where the x axis leaves it.
constexpr double kVoxel = 0.5;
constexpr double kRadius = 32.0 * kVoxel;

Window near_pole() {
  return sampled(ball(kRadius), {kRadius, 0, 0}, 12.0, kVoxel, {0.1, 0.2, 0.3});
}

ForceResult at_point(const Window& window, const Vec3& place, const ForceMaterial& material) {
  return point_force(window.view, ball_tool(1.0, place), material);
}

/// Directions around +x, within the sampled part of the ball.
std::vector<Vec3> directions() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(-0.35, 0.35);
  std::vector<Vec3> result;
  result.reserve(500);
  for (int i = 0; i < 500; ++i) result.push_back(normalized(Vec3{1.0, side(random), side(random)}));
  return result;
}

TEST(PointForce, IsTheSurfaceForceOnTheSurface) {
  const Window window = near_pole();
  const ForceMaterial material;
  for (const Vec3& n : directions()) {
    const Vec3 force = at_point(window, kRadius * n, material).contact_n;
    ASSERT_NEAR(length(force), material.surface_force_n, 0.01 * material.surface_force_n);
    ASSERT_LE(angle_deg(force, n), 0.5);
  }
}

TEST(PointForce, RisesWithTheSlopeOfTheLaw) {
  const Window window = near_pole();
  constexpr double kStep = 0.02;
  for (const double e : {1.0, 1.5, 2.0, 4.0}) {
    ForceMaterial material;
    material.exponent = e;
    const double expected = e * material.surface_force_n / material.skin_mm;
    double sum = 0.0;
    for (const Vec3& n : directions()) {
      const double in = length(at_point(window, (kRadius - kStep) * n, material).contact_n);
      const double out = length(at_point(window, (kRadius + kStep) * n, material).contact_n);
      sum += (in - out) / (2.0 * kStep);
    }
    EXPECT_NEAR(sum / static_cast<double>(directions().size()), expected, 0.02 * expected) << e;
  }
}

TEST(PointForce, IsClampedExactly) {
  const Window window = near_pole();
  ForceMaterial material;
  material.exponent = 4.0;  // the clamp sets in 2.2 mm below the surface
  for (const Vec3& n : directions()) {
    const Vec3 force = at_point(window, (kRadius - 4.0) * n, material).contact_n;
    ASSERT_NEAR(length(force), material.clamp_ratio * material.surface_force_n, 1e-12);
  }
}

TEST(PointForce, FadesToZeroOneSkinOutside) {
  const Window window = near_pole();
  const ForceMaterial material;
  const Vec3 n{1, 0, 0};
  EXPECT_GT(length(at_point(window, (kRadius + 7.5) * n, material).contact_n), 0.0);
  EXPECT_EQ(at_point(window, (kRadius + 8.5) * n, material).contact_n, Vec3{});
}

TEST(PointForce, IsZeroWhereTheGradientIsZero) {
  const Window plateau = sampled([](const Vec3&) { return -2.0; }, {}, 4.0, 0.5);
  const Window crest = sampled(slab(6.0), {}, 4.0, 0.5);
  const ForceMaterial material;
  EXPECT_EQ(at_point(plateau, {0.1, 0.2, 0.3}, material).contact_n, Vec3{});
  EXPECT_EQ(at_point(crest, {0.1, 0.2, 0.0}, material).contact_n, Vec3{});
}

TEST(Equation2, IsThePrintedLawAtEveryDepthAndTheClampBeyond) {
  const Window window = sampled(plane({0, 0, 1}), {}, 16.0, 0.5);
  for (const double e : {1.0, 1.5, 2.0, 4.0, 8.0}) {
    ForceMaterial material;
    material.exponent = e;
    const double clamp = material.clamp_ratio * material.surface_force_n;
    for (int n = -1500; n <= 1500; ++n) {
      const double z = 0.01 * n;
      const double u = std::max(0.0, 1.0 - z / material.skin_mm);
      const double printed = std::min(material.surface_force_n * std::pow(u, e), clamp);
      const Vec3 force = at_point(window, {1.0, -2.0, z}, material).contact_n;
      ASSERT_LE(length(force - Vec3{0.0, 0.0, printed}), 1e-12) << e << " at " << z;
    }
  }
}

TEST(Equation2, SlopeOnTheSurfaceIsThatOfTheField) {
  // Blurred or sharpened clay: V falls slower or faster than a distance does.
  constexpr double kStep = 1e-3;
  for (const double steepness : {0.5, 1.0, 2.0}) {
    const Window window = sampled([=](const Vec3& p) { return steepness * p.z; }, {}, 8.0, 0.5);
    for (const double e : {1.0, 2.0, 4.0}) {
      ForceMaterial material;
      material.exponent = e;
      const double in = at_point(window, {0.1, 0.2, -kStep}, material).contact_n.z;
      const double out = at_point(window, {0.1, 0.2, kStep}, material).contact_n.z;
      const double expected = e * material.surface_force_n * steepness / material.skin_mm;
      EXPECT_NEAR((in - out) / (2.0 * kStep), expected, 1e-6 * expected);
    }
  }
}

TEST(PointForce, DragsWithTheReportsForceOnTheSurface) {
  const Window window = sampled(plane({0, 0, 1}), {}, 4.0, 0.5);
  const ForceMaterial material;
  ForceTool tool = ball_tool(1.0, {0.2, 0.1, 0.0});
  tool.velocity_mm_per_s = normalized(Vec3{1, -2, 3}) / material.viscosity_s_per_mm;
  const ForceResult result = point_force(window.view, tool, material);
  EXPECT_NEAR(length(result.viscosity_n), material.viscosity_force_n, 1e-12);
  EXPECT_LE(
      length(result.viscosity_n + material.viscosity_force_n * normalized(tool.velocity_mm_per_s)),
      1e-12);
}

TEST(PointForce, NeverGainsEnergyFromDrag) {
  const Window window = sampled(ball(6.0), {}, 12.0, 1.0);
  const ForceMaterial material;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-12.0, 12.0);
  std::normal_distribution<double> speed(0.0, 100.0);
  int gains = 0;
  int drags = 0;
  for (int i = 0; i < 1000000; ++i) {
    ForceTool tool = ball_tool(1.0, {place(random), place(random), place(random)});
    tool.velocity_mm_per_s = {speed(random), speed(random), speed(random)};
    const double power =
        dot(point_force(window.view, tool, material).viscosity_n, tool.velocity_mm_per_s);
    gains += power > 0.0 ? 1 : 0;
    drags += power < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(gains, 0);
  EXPECT_GT(drags, 100000);
}

TEST(PointForce, SaysWhenTheToolLeftTheWindow) {
  const Window window = sampled(plane({0, 0, 1}), {}, 4.0, 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& place : {Vec3{9, 0, 0}, Vec3{0, 0, -1e300}, Vec3{nan, 0, 0}}) {
    const ForceResult result = at_point(window, place, {});
    EXPECT_TRUE(result.outside_window);
    EXPECT_EQ(result.contact_n, Vec3{});
    EXPECT_EQ(result.samples, 0);
  }
  EXPECT_FALSE(at_point(window, {1, 1, 1}, {}).outside_window);
}

}  // namespace
}  // namespace argil::haptics
