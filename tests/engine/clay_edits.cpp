// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "argil/engine/clay.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

Clay small_ball() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::ball(10.0, options).value();
}

TEST(ClayBall, HoldsItsInvariantsAndIsStoredNoFinerThanNeeded) {
  for (const double voxel : {0.1, 0.25, 1.0}) {
    ClayOptions options;
    options.voxel_mm = voxel;
    const Clay clay = Clay::ball(12.0, options).value();
    EXPECT_EQ(joined(clay.validate()), "") << "voxel " << voxel;
    for (const Vec3 p : {Vec3{12, 0, 0}, Vec3{0, -7.2, 9.6}, Vec3{4, 4, 10.5830052}}) {
      EXPECT_NEAR(clay.distance_at(p), length(p) - 12.0, 0.1 * voxel);
    }
  }
}

TEST(ClayBlock, KeepsSharpEdgesAtTheFinestLevelOnly) {
  ClayOptions options;
  options.voxel_mm = 0.25;
  const Clay clay = Clay::block({20, 16, 12}, options).value();
  EXPECT_EQ(joined(clay.validate()), "");
  EXPECT_NEAR(clay.distance_at({10, 0, 0}), 0.0, 0.05);
  EXPECT_GT(clay.level_stats()[0].leaves, 0);
  EXPECT_LT(clay.level_stats()[0].active_voxels, 150000);
}

TEST(ClayCreate, RefusesBadNumbersByName) {
  const auto message = [](const Result<Clay>& r) {
    return r.ok() ? std::string("no error") : r.error().message;
  };
  ClayOptions options;
  EXPECT_NE(message(Clay::ball(-1.0, options)).find("radius_mm is -1"), std::string::npos);
  EXPECT_NE(message(Clay::ball(std::nan(""), options)).find("radius_mm"), std::string::npos);
  EXPECT_NE(message(Clay::block({1, 0, 1}, options)).find("size_mm"), std::string::npos);
  options.voxel_mm = 0.0;
  EXPECT_NE(message(Clay::ball(10.0, options)).find("voxel_mm is 0"), std::string::npos);
}

class EachAction : public testing::TestWithParam<Action> {};

TEST_P(EachAction, LeavesAValidClayAndUndoesBitForBit) {
  Clay clay = small_ball();
  const std::uint64_t start = clay.hash();
  Stroke stroke;
  stroke.tool = {GetParam(), Shape::ball, {4, 4, 4}, 0.8};
  stroke.samples = {{0.0, {8, 0, 0}, {}, 1.0}, {1.0, {6, 6, 2}, {}, 1.0}};
  const auto report = clay.apply(stroke);
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report.value().dabs, 3);
  EXPECT_EQ(joined(clay.validate()), "");
  const std::uint64_t after = clay.hash();
  EXPECT_NE(after, start);
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
  ASSERT_TRUE(clay.redo());
  EXPECT_EQ(clay.hash(), after);
  EXPECT_FALSE(clay.redo());
}

INSTANTIATE_TEST_SUITE_P(Clay, EachAction,
                         testing::Values(Action::add, Action::carve, Action::smooth,
                                         Action::inflate));

class RandomEditsProperty : public testing::TestWithParam<int> {};

TEST_P(RandomEditsProperty, KeepEveryInvariantAfterEveryDab) {
  constexpr int kSequences = 10;
  for (int n = 0; n < kSequences; ++n) {
    const auto seed = static_cast<std::uint32_t>(GetParam() * kSequences + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Clay clay = random_start(random);
    const std::uint64_t start = clay.hash();
    ASSERT_EQ(joined(clay.validate()), "");
    const int strokes = 3 + static_cast<int>(random() % 4);
    for (int i = 0; i < strokes; ++i) {
      const Stroke stroke = random_dab(random, 10.0);
      SCOPED_TRACE("stroke " + std::to_string(i) + ": " + describe(stroke));
      ASSERT_TRUE(clay.apply(stroke).ok());
      ASSERT_EQ(joined(clay.validate()), "");
    }
    while (clay.undo()) {
    }
    ASSERT_EQ(clay.hash(), start);
  }
}

INSTANTIATE_TEST_SUITE_P(Clay, RandomEditsProperty, testing::Range(0, 10));

}  // namespace
}  // namespace argil
