// SPDX-License-Identifier: GPL-3.0-or-later
// Where a ray leaves the clay, against small steps along it.
#include "raycast/field_ray.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "support/effort.h"

namespace argil {
namespace {

constexpr double kRayVoxelMm = 0.25;

/// A hollow ball with a groove, whose levels are several.
Clay shell() {
  Box3 box;
  box.include(Vec3{-9, -9, -9});
  box.include(Vec3{9, 9, 9});
  const auto distance = [](const Vec3& p) {
    return std::max(length(p) - 8.0, 6.0 - length(p - Vec3{0.5, 0.3, 0.2}));
  };
  Clay clay = Clay::from_distance(distance, box, ClayOptions{.voxel_mm = kRayVoxelMm}).value();
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {1.0, 1.0, 1.0};
  stroke.samples = {{0.0, {-2.0, 0.0, 8.0}, {}, 1.0}, {1.0, {2.0, 0.0, 8.0}, {}, 1.0}};
  EXPECT_TRUE(clay.apply(stroke));
  return clay;
}

/// The first step along the ray that is outside after one that was inside; negative: none.
double exit_by_steps(const Clay& clay, const Vec3& from, const Vec3& direction, double step) {
  bool was_inside = false;
  for (double along = 0.0; along < 30.0; along += step) {
    const bool inside = clay.distance_at(from + along * direction) < 0.0;
    if (was_inside && !inside) return along;
    was_inside = inside;
  }
  return -1.0;
}

TEST(FieldRay, LeavesTheClayWhereSmallStepsDo) {
  const Clay clay = shell();
  const FieldExits exits_of(levels_of(clay));
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  constexpr double kStep = 0.005;
  int exits = 0;
  int misses = 0;
  const int rays = test::effort(120, 400);
  for (int n = 0; n < rays; ++n) {
    const Vec3 from{10.0 * number(), 10.0 * number(), 10.0 * number()};
    const Vec3 direction = normalized(Vec3{number(), number(), number()});
    const double slow = exit_by_steps(clay, from, direction, kStep);
    const auto exit = exits_of.first(from / kRayVoxelMm, direction);
    ASSERT_EQ(exit.has_value(), slow >= 0.0) << n;
    if (!exit) {
      ++misses;
      continue;
    }
    EXPECT_NEAR(exit->along * kRayVoxelMm, slow, 1.01 * kStep) << n;
    ++exits;
  }
  EXPECT_GT(exits, rays / 4);
  EXPECT_GT(misses, rays / 20);
}

}  // namespace
}  // namespace argil
