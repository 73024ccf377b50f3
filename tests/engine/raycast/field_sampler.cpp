// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/field_sampler.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"

namespace argil {
namespace {

constexpr double kSampledVoxelMm = 0.25;

/// A ball of 100 voxels with a groove: levels of which leaves were dropped, in more octants than a
/// sampler remembers.
Clay grooved_ball() {
  Clay clay = Clay::ball(25.0, ClayOptions{.voxel_mm = kSampledVoxelMm}).value();
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {2.5, 2.5, 2.5};
  stroke.samples = {{0.0, {-18.0, 0.0, 18.0}, {}, 1.0}, {1.0, {18.0, 0.0, 18.0}, {}, 1.0}};
  EXPECT_TRUE(clay.apply(stroke));
  return clay;
}

/// Points in the band and beyond it, those of a row near one another.
std::vector<Vec3> points_about(double radius_mm, std::size_t count) {
  std::mt19937 random(11);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 at = normalized(Vec3{number(), number(), number()}) * (radius_mm + 1.5 * number());
    for (int n = 0; n < 3; ++n) {
      points.push_back(at + Vec3{0.3 * number(), 0.3 * number(), 0.3 * number()});
    }
  }
  return points;
}

TEST(FieldSampler, SaysWhatTheClaySaysWhateverWasAskedBefore) {
  const Clay clay = grooved_ball();
  FieldSampler field(clay);
  const std::vector<Vec3> points = points_about(25.0, 150'000);
  for (const Vec3& p : points) {
    ASSERT_NEAR(field.distance_mm(p), clay.distance_at(p), 1e-9) << p.x << ' ' << p.y << ' ' << p.z;
  }
  // Again, when much of what it knew is forgotten, and by one that knows nothing.
  for (std::size_t n = 0; n < 300; ++n) {
    FieldSampler other(clay);
    ASSERT_EQ(field.distance_mm(points[n]), other.distance_mm(points[n])) << n;
  }
}

/// Farther out than an int counts voxels.
TEST(FieldSampler, AnswersForAnyFinitePoint) {
  Clay clay = grooved_ball();
  ASSERT_TRUE(clay.apply(MaskEdit::fill));
  FieldSampler field(clay);
  for (const double far : {1e7, 1e9, 1e12, 1e300}) {
    for (const Vec3& p : {Vec3{far, 0.0, 0.0}, Vec3{0.0, -far, far}, Vec3{-far, -far, -far}}) {
      EXPECT_EQ(field.distance_mm(p), clay.distance_at(p)) << far;
      EXPECT_GT(field.distance_mm(p), 0.0) << far;
      EXPECT_EQ(field.value(p).gradient, Vec3{}) << far;
      EXPECT_EQ(clay.mask_at(p), 1.0) << far;
    }
  }
  EXPECT_LT(field.distance_mm({}), 0.0) << "and goes on";
}

TEST(FieldSampler, GivesTheCornersOfCellsBitForBit) {
  const Clay clay = grooved_ball();
  const LevelStack& levels = levels_of(clay);
  FieldSampler field(clay);
  std::vector<int> met(static_cast<std::size_t>(levels.count()), 0);
  for (const Vec3& p : points_about(25.0, 20'000)) {
    const FieldCell cell = field.cell_at(p);
    if (cell.per_mm == 0.0) continue;
    ++met[static_cast<std::size_t>(cell.level)];
    const Vec3 low = cell.per_mm * p - cell.fraction;
    const Coord node(static_cast<int>(std::lround(low.x)), static_cast<int>(std::lround(low.y)),
                     static_cast<int>(std::lround(low.z)));
    for (int corner = 0; corner < 8; ++corner) {
      const Coord at = node.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1);
      ASSERT_EQ(cell.corners[static_cast<std::size_t>(corner)], levels.node_value(cell.level, at));
    }
  }
  EXPECT_GT(met[0], 100);
  EXPECT_GT(met[1], 100);
}

}  // namespace
}  // namespace argil
