// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/tool_force.h"

#include "haptics/force/fields.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using namespace fields;

// Row (1) of docs/equations.md for the volume: drag from the moments of the density.

constexpr ForceLaw kLawsThatDamp[] = {ForceLaw::energy, ForceLaw::blanch};
const int kDrags = argil::test::effort(20'000, 100'000);  // at random

TEST(Viscosity, EqualsThePointInAUniformField) {
  const Window window = sampled([](const Vec3&) { return -3.0; }, {}, 8.0, 0.5);
  ForceTool tool = ball_tool(4.0, {0.1, 0.2, 0.05});
  tool.velocity_mm_per_s = {30, -50, 20};
  const Vec3 point = point_force(window.view, tool, {}).viscosity_n;
  ASSERT_GT(length(point), 0.1);
  for (const ForceLaw law : kLawsThatDamp) {
    const Vec3 volume = volume_force(window.view, tool, {}, law).viscosity_n;
    EXPECT_LE(length(volume - point), 1e-6 * length(point));
  }
}

TEST(Viscosity, IsTheDensityUnderTheKernelOnASlope) {
  const Window window = sampled(plane({0, 0, 1}), {}, 8.0, 0.5);
  const ForceMaterial material;  // the skin reaches beyond the kernel: density is linear under it
  ForceTool tool = ball_tool(4.0, {0.1, 0.2, 1.0});
  tool.velocity_mm_per_s = {100, 0, 0};
  const ForceResult result = volume_force(window.view, tool, material, ForceLaw::energy);
  const double u = 1.0 - 1.0 / material.skin_mm;
  EXPECT_NEAR(result.viscosity_n.x, -u * material.viscosity_force_n, 1e-3);
  // Denser below the centre, where the drag's lever arm is -z.
  EXPECT_GT(result.viscosity_nmm.y, 0.1);
}

TEST(Viscosity, ResistsSpinning) {
  const Window window = sampled([](const Vec3&) { return 0.0; }, {}, 8.0, 0.5);
  const ForceMaterial material;
  ForceTool tool = ball_tool(4.0, {});
  tool.angular_velocity_rad_per_s = {0, 0, 10};
  const ForceResult result = volume_force(window.view, tool, material, ForceLaw::energy);
  EXPECT_LE(length(result.viscosity_n), 1e-9);
  // Uniform density: two axes of <z^2> = support^2 / 13 each.
  const double support = kKernelSupport * 4.0;
  const double expected = -material.viscosity_s_per_mm * material.viscosity_force_n * 10.0 * 2.0 *
                          support * support / 13.0;
  EXPECT_NEAR(result.viscosity_nmm.z, expected, 1e-3 * std::abs(expected));
}

TEST(Viscosity, NeverGainsEnergy) {
  const Window window = sampled(blended_balls(6), {2, 0, 0}, 26.0, 2.0);
  ForceTool tool;
  tool.radii_mm = {4.0, 5.0, 6.0};
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> place(-16.0, 16.0);
  std::normal_distribution<double> some(0.0, 1.0);
  int gains = 0;
  for (int i = 0; i < kDrags; ++i) {
    tool.position_mm = {2.0 + place(random), place(random), place(random)};
    tool.orientation = normalized(Quat{some(random), some(random), some(random), some(random)});
    tool.velocity_mm_per_s = 100.0 * Vec3{some(random), some(random), some(random)};
    tool.angular_velocity_rad_per_s = 20.0 * Vec3{some(random), some(random), some(random)};
    const ForceResult result =
        volume_force(window.view, tool, {}, kLawsThatDamp[static_cast<std::size_t>(i % 2)]);
    const double power = dot(result.viscosity_n, tool.velocity_mm_per_s) +
                         dot(result.viscosity_nmm, tool.angular_velocity_rad_per_s);
    gains += power > 1e-9 ? 1 : 0;
  }
  EXPECT_EQ(gains, 0);
}

TEST(Equation1, IsThePrintedProductAtAPoint) {
  const Window window = sampled(plane({0, 0, 1}), {}, 16.0, 0.5);
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> speed(0.0, 100.0);
  for (int i = 0; i < 10000; ++i) {
    ForceMaterial material;
    material.viscosity_force_n = 8.0 * share(random);
    material.viscosity_s_per_mm = 0.1 * share(random);
    ForceTool tool = ball_tool(1.0, {1.0, -2.0, 30.0 * share(random) - 15.0});
    tool.velocity_mm_per_s = {speed(random), speed(random), speed(random)};
    const double density = std::max(0.0, 1.0 - tool.position_mm.z / material.skin_mm);
    const Vec3 printed = -material.viscosity_s_per_mm * material.viscosity_force_n * density *
                         tool.velocity_mm_per_s;
    const Vec3 force = point_force(window.view, tool, material).viscosity_n;
    ASSERT_LE(length(force - printed), 1e-12 * (1.0 + length(printed)));
  }
}

ForceResult lattice_drag(const Distance& field, const ForceTool& tool) {
  const Lattice lattice = choose_lattice(tool);
  const Window window =
      sampled(field, tool.position_mm, window_reach_mm(tool, lattice, 0.0), lattice.voxel_mm);
  return LatticeForce(tool, {}, ForceLaw::energy, lattice.voxel_mm).evaluate(window.view, tool);
}

TEST(Equation1, OfTheServosSumIsThePointsInAUniformField) {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    ForceTool tool = ball_tool(4.0, {place(random), place(random), place(random)});
    tool.velocity_mm_per_s = {30, -50, 20};
    // -3 mm everywhere: a density of 1.375.
    const ForceMaterial material;
    const Vec3 point =
        -material.viscosity_s_per_mm * material.viscosity_force_n * 1.375 * tool.velocity_mm_per_s;
    const Vec3 sum = lattice_drag([](const Vec3&) { return -3.0; }, tool).viscosity_n;
    ASSERT_LE(length(sum - point), 1e-4 * length(point));
  }
}

TEST(Equation1, OfTheServosSumNeverGainsEnergy) {
  const Lattice lattice = choose_lattice(ball_tool(4.0, {}));
  const Window window = sampled(blended_balls(6), {2, 0, 0}, 26.0, lattice.voxel_mm);
  const LatticeForce force(ball_tool(4.0, {}), {}, ForceLaw::energy, lattice.voxel_mm);
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> place(-16.0, 16.0);
  std::normal_distribution<double> some(0.0, 1.0);
  int gains = 0;
  int drags = 0;
  for (int i = 0; i < kDrags; ++i) {
    ForceTool tool = ball_tool(4.0, {2.0 + place(random), place(random), place(random)});
    tool.velocity_mm_per_s = 100.0 * Vec3{some(random), some(random), some(random)};
    tool.angular_velocity_rad_per_s = 20.0 * Vec3{some(random), some(random), some(random)};
    const ForceResult result = force.evaluate(window.view, tool);
    const double power = dot(result.viscosity_n, tool.velocity_mm_per_s) +
                         dot(result.viscosity_nmm, tool.angular_velocity_rad_per_s);
    gains += power > 0.0 ? 1 : 0;
    drags += power < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(gains, 0);
  EXPECT_GT(drags, kDrags / 10);
}

}  // namespace
}  // namespace argil::haptics
