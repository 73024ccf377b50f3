// SPDX-License-Identifier: GPL-3.0-or-later
// What offsets say at the nodes of single leaves, against formulas.
#include "operation/moved_level.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "field/nesting.h"
#include "operation/combine.h"

namespace argil {
namespace {

constexpr double kVoxel = 0.25;

using Formula = std::function<double(const Vec3&)>;

double torus(const Vec3& p) {
  const double around = std::hypot(p.x, p.y) - 9.0;
  return std::hypot(around, p.z) - 4.0;
}

Clay clay_of(const Formula& distance, double reach) {
  return Clay::from_distance(distance, {{-reach, -reach, -reach}, {reach, reach, reach}},
                             {kVoxel, 0.02, 0.0})
      .value();
}

MovedLevel moved_level(const PlacedClay& source, double voxel) {
  return MovedLevel(source, voxel,
                    placed_feet(levels_of(source.clay), MovedLevel::wanted(source, voxel)).value());
}

/// The greatest error within the band of a level, in its voxels, and how many nodes were compared.
struct Compared {
  double worst = 0.0;
  int nodes = 0;
};

Compared compare(const Clay& clay, const Placement& placement, double offset, int level,
                 double reach, const Formula& exact) {
  const double voxel = levels_of(clay).voxel_mm(level);
  const MovedLevel moved = moved_level({clay, placement, offset}, voxel);
  const double band = kHalfWidthVoxels * voxel;
  const int end = static_cast<int>(reach / voxel / kLeafSide) + 1;
  Compared out;
  for_each_node({Coord(-end, -end, -end), Coord(end - 1, end - 1, end - 1)}, [&](const Coord& at) {
    LeafValues values;
    bool detail = false;
    const bool is_filled = moved.fill(at << 3, values, detail);
    for (int n = 0; n < kLeafNodes; ++n) {
      const double wanted = exact(node_mm((at << 3).offsetBy(n >> 6, n >> 3 & 7, n & 7), voxel));
      if (std::abs(wanted) >= band) continue;
      ASSERT_TRUE(is_filled);
      const auto value = static_cast<double>(values[static_cast<std::size_t>(n)]);
      out.worst = std::max(out.worst, std::abs(value - wanted) / voxel);
      ++out.nodes;
    }
  });
  EXPECT_GT(out.nodes, 1000);
  return out;
}

TEST(MovedLevel, IsExactBesideATorus) {
  const Clay clay = clay_of(torus, 14.0);
  for (const double voxels : {-9.0, -4.0, -1.0, 0.5, 2.0, 4.5, 12.0}) {
    const double offset = voxels * kVoxel;
    const Compared found =
        compare(clay, {}, offset, 0, 18.0, [&](const Vec3& p) { return torus(p) - offset; });
    EXPECT_LT(found.worst, 0.06) << voxels << " voxels";
  }
}

TEST(MovedLevel, IsNearlyExactFarAway) {
  // By feet of coarser levels.
  const Clay clay = clay_of(torus, 14.0);
  for (const double voxels : {24.0, 48.0}) {
    const double offset = voxels * kVoxel;
    const Compared found = compare(clay, {}, offset, 0, 14.0 + offset + 2.0,
                                   [&](const Vec3& p) { return torus(p) - offset; });
    EXPECT_LT(found.worst, 0.2) << voxels << " voxels";
  }
}

TEST(MovedLevel, IsExactAtCoarserLevels) {
  const Clay clay = clay_of(torus, 14.0);
  for (const int level : {1, 2}) {
    const Compared found =
        compare(clay, {}, 2.0, level, 18.0, [](const Vec3& p) { return torus(p) - 2.0; });
    // A coarser level is the average of what is finer.
    EXPECT_LT(found.worst, 0.1) << "level " << level;
  }
}

TEST(MovedLevel, TurnsAndMoves) {
  const Clay clay = clay_of(torus, 14.0);
  const Placement placement{{1.3, -0.7, 2.1}, normalized(Quat{1.0, 0.4, -0.3, 0.2})};
  const Compared found = compare(clay, placement, 0.0, 0, 18.0, [&](const Vec3& p) {
    return torus(rotate(conjugate(placement.orientation), p - placement.position_mm));
  });
  EXPECT_LT(found.worst, 0.07);
}

/// A ball below a wall of which nothing must be left after an offset inward.
void expect_wall_gone(double half_mm, double offset) {
  const auto ball_and_wall = [&](const Vec3& p) {
    const Vec3 off{std::abs(p.x) - 8.0, std::abs(p.y) - 8.0, std::abs(p.z - 9.0) - half_mm};
    const double wall = std::max({off.x, off.y, off.z});
    return std::min(wall, length(p) - 6.0);
  };
  const Clay clay = clay_of(ball_and_wall, 12.0);
  const MovedLevel moved = moved_level({clay, {}, offset}, kVoxel);
  for_each_node({Coord(-6, -6, 0), Coord(5, 5, 5)}, [&](const Coord& at) {
    LeafValues values;
    bool detail = false;
    if (!moved.fill(at << 3, values, detail)) return;
    for (int n = 0; n < kLeafNodes; ++n) {
      const Vec3 node = node_mm((at << 3).offsetBy(n >> 6, n >> 3 & 7, n & 7), kVoxel);
      if (node.z < 7.5) continue;
      ASSERT_GT(values[static_cast<std::size_t>(n)], 0.0F)
          << node.x << ", " << node.y << ", " << node.z << " by " << offset;
    }
  });
}

TEST(MovedLevel, TakesAWallAwayThatIsThinnerThanTwice) {
  // Too thin for feet of its own inside, and those of the ball are not its own.
  expect_wall_gone(0.6, -0.75);
  expect_wall_gone(0.6, -2.0);
  expect_wall_gone(0.3125, -0.33);
  expect_wall_gone(0.25, -0.27);
}

TEST(MovedLevel, KeepsACombTooFineForFeet) {
  // Teeth and gaps two voxels wide: neither has a layer.
  const auto comb = [](const Vec3& p) {
    const double tooth = std::abs(p.x / (4.0 * kVoxel) - std::round(p.x / (4.0 * kVoxel)));
    const double teeth = (tooth - 0.25) * 4.0 * kVoxel;
    return std::max({teeth, std::abs(p.x) - 4.0, std::abs(p.y) - 4.0, std::abs(p.z) - 4.0});
  };
  const Clay clay = clay_of(comb, 5.0);
  const MovedLevel moved = moved_level({clay, {}, 0.3 * kVoxel}, kVoxel);
  const double wanted_voxels[] = {-1.3, -0.3, 0.7};  // across a tooth's side
  for (int n = 0; n < 3; ++n) {
    LeafValues values;
    bool detail = false;
    ASSERT_TRUE(moved.fill({0, 0, 0}, values, detail));
    EXPECT_NEAR(static_cast<double>(values[static_cast<std::size_t>(64 * n + 9)]),
                wanted_voxels[n] * kVoxel, 0.05 * kVoxel);
  }
}

}  // namespace
}  // namespace argil
