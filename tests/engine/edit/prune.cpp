// SPDX-License-Identifier: GPL-3.0-or-later
// What pruning leaves: fine leaves only where the coarser levels do not describe the clay as well.
#include <cmath>
#include <cstdio>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"

namespace argil {
namespace {

/// Nodes of an infinite lattice of spacing `voxel` with | |p| - radius | < band, counted column by
/// column: what a uniform level set of the ball would store.
std::int64_t uniform_active_voxels(double radius, double voxel) {
  const double outer = radius / voxel + kHalfWidthVoxels;
  const double inner = radius / voxel - kHalfWidthVoxels;
  const auto half_column = [](double r, double square) {
    const double rest = r * r - square;
    return rest < 0.0 ? 0.0 : 2.0 * std::floor(std::sqrt(rest)) + 1.0;
  };
  double count = 0.0;
  const int most = static_cast<int>(outer);
  for (int i = -most; i <= most; ++i) {
    for (int j = -most; j <= most; ++j) {
      const double square = static_cast<double>(i) * i + static_cast<double>(j) * j;
      count += half_column(outer, square) - half_column(inner, square);
    }
  }
  return static_cast<std::int64_t>(count);
}

/// A wavy line engraved into a large ball, its way a share of the ball's radius.
void expect_stored_twenty_times_smaller(double ball_mm) {
  ClayOptions options;
  options.voxel_mm = 0.05;  // 8 voxels across the radius of the engraving tool
  Clay clay = Clay::ball(ball_mm, options).value();
  Stroke engraving;
  engraving.tool = {Action::carve, Shape::ball, {0.4, 0.4, 0.4}, 1.0};
  for (int i = 0; i < 60; ++i) {
    const double a = 0.3 * i / 60.0;
    const Vec3 along{std::cos(a), std::sin(a), 0.03 * std::sin(8.0 * a)};
    engraving.samples.push_back({0.01 * i, ball_mm * along, {}, 1.0});
  }
  const auto report = clay.apply(engraving);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().level, 0);
  EXPECT_THAT(clay.validate(), testing::IsEmpty());
  std::int64_t stored = 0;
  for (const LevelStats& level : clay.level_stats()) stored += level.active_voxels;
  const std::int64_t uniform = uniform_active_voxels(ball_mm, options.voxel_mm);
  testing::Test::RecordProperty("stored_active_voxels", std::to_string(stored));
  testing::Test::RecordProperty("uniform_active_voxels", std::to_string(uniform));
  std::printf("stored %lld, uniform %lld: %.0f times fewer\n", static_cast<long long>(stored),
              static_cast<long long>(uniform),
              static_cast<double>(uniform) / static_cast<double>(stored));
  EXPECT_GE(uniform, 20 * stored);
  const TriangleMesh mesh = extract_surface(clay);
  EXPECT_EQ(test::find_mesh_faults(mesh), test::MeshFaults{});
  EXPECT_EQ(test::find_soup_faults(mesh), test::SoupFaults{});
  EXPECT_EQ(test::find_soup_faults(test::rounded_to_float(mesh)), test::SoupFaults{});
}

TEST(AdaptiveLevels, StoreAFineEngravingOnABallTwentyTimesSmaller) {
  expect_stored_twenty_times_smaller(12.5);
}

TEST(AdaptiveLevelsSlow, StoreAFineEngravingOnALargeBallTwentyTimesSmaller) {
  expect_stored_twenty_times_smaller(100.0);
}

}  // namespace
}  // namespace argil
