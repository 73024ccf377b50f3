// SPDX-License-Identifier: GPL-3.0-or-later
#include "window/window_levels.h"

#include <cmath>

#include <gtest/gtest.h>

namespace argil {
namespace {

constexpr double kFinest = 0.25;
constexpr int kCoarsest = 6;

TEST(WindowLevels, AreNoCoarserThanTheSpacingAndNoFinerThanHalf) {
  for (int step = 0; step < 60; ++step) {
    const double voxel = 0.25 * std::pow(1.07, step);
    const double stored = std::ldexp(kFinest, choose_level(voxel, kFinest, kCoarsest).level);
    EXPECT_LE(stored, voxel);
    EXPECT_GT(2.0 * stored, voxel);
  }
}

TEST(WindowLevels, ChangeExactlyAtTheBorder) {
  EXPECT_EQ(choose_level(0.25, kFinest, kCoarsest).level, 0);
  EXPECT_EQ(choose_level(std::nextafter(0.5, 0.0), kFinest, kCoarsest).level, 0);
  EXPECT_EQ(choose_level(0.5, kFinest, kCoarsest).level, 1);
}

TEST(WindowLevels, BlendOverAQuarterOctaveLinearlyInLog2) {
  for (const double octaves : {0.0, 0.05, 0.125, 0.2, 0.2499}) {
    const LevelChoice choice = choose_level(0.5 * std::exp2(octaves), kFinest, kCoarsest);
    EXPECT_EQ(choice.level, 1);
    EXPECT_EQ(choice.finer_level, 0);
    EXPECT_NEAR(choice.finer_fraction, 1.0 - octaves / 0.25, 1e-9);
  }
  const LevelChoice alone = choose_level(0.5 * std::exp2(0.26), kFinest, kCoarsest);
  EXPECT_EQ(alone.finer_level, alone.level);
  EXPECT_EQ(alone.finer_fraction, 0.0);
}

TEST(WindowLevels, StayWithinThoseStored) {
  for (const double voxel : {0.001, 0.2, 0.25, 0.29}) {
    const LevelChoice choice = choose_level(voxel, kFinest, kCoarsest);
    EXPECT_EQ(choice.level, 0);
    EXPECT_EQ(choice.finer_level, 0);
  }
  const LevelChoice choice = choose_level(125.0, kFinest, 2);
  EXPECT_EQ(choice.level, 2);
  EXPECT_EQ(choice.finer_level, 2);
  EXPECT_EQ(choice.finer_fraction, 0.0);
}

}  // namespace
}  // namespace argil
