// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "argil/haptics/tool_force.h"

#include "haptics/fields.h"

namespace argil::haptics {
namespace {

constexpr double kFinest = 0.25;
constexpr int kCoarsest = 6;

TEST(ChooseLevel, PutsEightToSixteenNodesAcrossTheTool) {
  for (int step = 0; step < 95; ++step) {
    const double radius = 0.05 * std::pow(1.07, step);
    const LevelChoice choice = choose_level(radius, kFinest, kCoarsest);
    const double across = 2.0 * radius / std::ldexp(kFinest, choice.level);
    EXPECT_GE(across, 8.0) << radius;
    EXPECT_LT(across, 16.0) << radius;
  }
}

TEST(ChooseLevel, ChangesExactlyAtTheBorder) {
  EXPECT_EQ(choose_level(1.0, kFinest, kCoarsest).level, 0);
  EXPECT_EQ(choose_level(std::nextafter(2.0, 0.0), kFinest, kCoarsest).level, 0);
  EXPECT_EQ(choose_level(2.0, kFinest, kCoarsest).level, 1);
  EXPECT_EQ(choose_level(std::nextafter(1.0, 0.0), kFinest, kCoarsest).level, -1);
  EXPECT_EQ(choose_level(0.125, kFinest, kCoarsest).level, -3);
}

TEST(ChooseLevel, BlendsOverAQuarterOctaveLinearlyInLog2) {
  for (const double octaves : {0.0, 0.05, 0.125, 0.2, 0.2499}) {
    const LevelChoice choice = choose_level(2.0 * std::exp2(octaves), kFinest, kCoarsest);
    EXPECT_EQ(choice.level, 1);
    EXPECT_EQ(choice.finer_level, 0);
    EXPECT_NEAR(choice.finer_share, 1.0 - octaves / 0.25, 1e-9);
  }
  const LevelChoice alone = choose_level(2.0 * std::exp2(0.26), kFinest, kCoarsest);
  EXPECT_EQ(alone.finer_level, alone.level);
  EXPECT_EQ(alone.finer_share, 0.0);
}

TEST(ChooseLevel, StaysAtTheCoarsest) {
  const LevelChoice choice = choose_level(500.0, kFinest, 2);
  EXPECT_EQ(choice.level, 2);
  EXPECT_EQ(choice.finer_level, 2);
  EXPECT_EQ(choice.finer_share, 0.0);
}

/// Growing the tool in small steps through two level changes must not be felt as a pop.
TEST(ChooseLevel, BlendedForceHasNoStep) {
  const fields::Distance field = fields::ball(24.0);
  const auto force = [&](double radius) {
    const LevelChoice choice = choose_level(radius, kFinest, kCoarsest);
    const auto at_level = [&](int level) {
      const fields::Window window = fields::sampled(field, {24, 0, 0}, 1.7 * radius,
                                                    std::ldexp(kFinest, level), {0.07, 0.03, 0.11});
      return length(
          volume_force(window.view, fields::ball_tool(radius, {24, 0, 0}), {}, ForceLaw::energy)
              .contact_n);
    };
    const double own = at_level(choice.level);
    if (choice.finer_level == choice.level) return own;
    return own + choice.finer_share * (at_level(choice.finer_level) - own);
  };
  double last = force(1.5);
  for (int step = 1; step < 114; ++step) {  // 1.5 to 4.6 mm
    const double radius = 1.5 * std::pow(1.01, step);
    const double next = force(radius);
    EXPECT_LE(std::abs(next - last), 1e-3 * next) << radius;
    last = next;
  }
}

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
