// SPDX-License-Identifier: GPL-3.0-or-later
// The feet of a whole clay and the search among them, against the shape itself and a search of all.
#include "feet/feet_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "support/bumpy_clay.h"

namespace argil {
namespace {

constexpr double kVoxel = 0.25;

struct SurfacePoint {
  Vec3 at;
  double voxel_mm;
};

void add_surface_points(const LayerFeet& layer, const Vec3& origin, double voxel, int begin,
                        int end, std::vector<SurfacePoint>& out) {
  const auto vector_at = [&](int field, int n) {
    return Vec3{static_cast<double>(layer.field(field)[n]),
                static_cast<double>(layer.field(field + 1)[n]),
                static_cast<double>(layer.field(field + 2)[n])};
  };
  for (int n = begin; n < end; ++n) {
    if (layer.field(LayerFeet::kX)[n] == kNowhere) continue;
    const Vec3 normal = vector_at(LayerFeet::kNormalX, n);
    out.push_back({origin + vector_at(LayerFeet::kX, n) - (kLayerVoxels * voxel) * normal, voxel});
  }
}

std::vector<SurfacePoint> surface_points(const std::vector<PlacedFeet>& feet,
                                         const LevelStack& stack) {
  std::vector<SurfacePoint> out;
  for (const PlacedFeet& each : feet) {
    add_surface_points(each.layer, each.origin_mm, stack.voxel_mm(each.level), 0,
                       each.layer.count(), out);
  }
  return out;
}

/// A block whose faces are coarse and whose edges are fine.
Clay block() { return Clay::block({20.0, 16.0, 12.0}, {kVoxel, 0.1, 0.0}).value(); }

double block_distance(const Vec3& p) {
  const Vec3 off{std::abs(p.x) - 10.0, std::abs(p.y) - 8.0, std::abs(p.z) - 6.0};
  const Vec3 out{std::max(off.x, 0.0), std::max(off.y, 0.0), std::max(off.z, 0.0)};
  return length(out) + std::min(0.0, std::max({off.x, off.y, off.z}));
}

TEST(PlacedFeet, StandForPointsOfTheSurface) {
  const Clay clay = block();
  const SidesOfFeet sides = placed_feet(levels_of(clay), {}).value();
  for (const auto& feet : sides) {
    double worst = 0.0;
    const std::vector<SurfacePoint> points = surface_points(feet, levels_of(clay));
    EXPECT_GT(points.size(), 1000U);
    for (const SurfacePoint& point : points) {
      worst = std::max(worst, std::abs(block_distance(point.at)) / point.voxel_mm);
    }
    EXPECT_LT(worst, 0.6);  // at the edges, which the clay has cut off
  }
}

TEST(PlacedFeet, LeaveNoPlaceOfTheSurfaceOut) {
  const Clay clay = block();
  const auto outside = placed_feet(levels_of(clay), {}).value()[0];
  const std::vector<SurfacePoint> points = surface_points(outside, levels_of(clay));
  for (const Vec3& place : extract_surface(clay).positions) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SurfacePoint& point : points) {
      nearest = std::min(nearest, length(point.at - place) / point.voxel_mm);
    }
    ASSERT_LT(nearest, 1.0) << place.x << ", " << place.y << ", " << place.z;
  }
}

TEST(PlacedFeet, AreNoFinerThanWanted) {
  const Clay clay = block();
  FeetWanted wanted;
  wanted.finest = 1;
  wanted.sides = {true, false};
  const SidesOfFeet feet = placed_feet(levels_of(clay), wanted).value();
  EXPECT_TRUE(feet[1].empty());
  ASSERT_FALSE(feet[0].empty());
  for (const PlacedFeet& each : feet[0]) EXPECT_GE(each.level, 1);
}

TEST(PlacedFeet, TurnAndMoveWithTheClay) {
  const Clay clay = block();
  FeetWanted wanted;
  wanted.placement = {{1.0, -2.0, 3.0}, normalized(Quat{1.0, 0.3, -0.2, 0.4})};
  const auto still = surface_points(placed_feet(levels_of(clay), {}).value()[0], levels_of(clay));
  const auto moved =
      surface_points(placed_feet(levels_of(clay), wanted).value()[0], levels_of(clay));
  ASSERT_EQ(still.size(), moved.size());
  for (std::size_t n = 0; n < still.size(); ++n) {
    const Vec3 there =
        rotate(wanted.placement.orientation, still[n].at) + wanted.placement.position_mm;
    ASSERT_LT(length(there - moved[n].at), 1e-4);
  }
}

/// A cube of nodes as leaves have them.
struct NodeCube {
  Vec3 center;
  double half;

  double nearest(const std::vector<SurfacePoint>& points, int corner) const {
    const Vec3 node =
        center + Vec3{(corner & 4) != 0 ? half : -half, (corner & 2) != 0 ? half : -half,
                      (corner & 1) != 0 ? half : -half};
    double nearest = std::numeric_limits<double>::infinity();
    for (const SurfacePoint& point : points) {
      nearest = std::min(nearest, length(point.at - node));
    }
    return nearest;
  }
};

class FeetTreeSearch : public testing::Test {
 protected:
  std::vector<SurfacePoint> found_points(FeetTree::Found& found, const Vec3& center) const {
    std::vector<SurfacePoint> points;
    for (std::size_t level = 0; level < found.lists.size(); ++level) {
      ClusterList& list = found.lists[level];
      for (std::size_t n = 0; n < list.size(); ++n) {
        const LayerCluster& cluster = list.cluster(n);
        for (int foot = 0; foot < cluster.count; ++foot) {
          const auto at = [&](int field) {
            return static_cast<double>(cluster.values[field * cluster.stride + foot]);
          };
          if (at(0) >= static_cast<double>(kNowhere)) continue;
          const double voxel = stack_.voxel_mm(static_cast<int>(level));
          const Vec3 offset{static_cast<double>(cluster.offset[0]),
                            static_cast<double>(cluster.offset[1]),
                            static_cast<double>(cluster.offset[2])};
          const Vec3 normal{at(3), at(4), at(5)};
          points.push_back(
              {center + offset + Vec3{at(0), at(1), at(2)} - (kLayerVoxels * voxel) * normal,
               voxel});
        }
      }
    }
    return points;
  }

  Clay clay_ = test::bumpy_ball(6.0, kVoxel).value();
  const LevelStack& stack_ = levels_of(clay_);
  std::vector<PlacedFeet> feet_ = placed_feet(stack_, {}).value()[0];
  std::vector<SurfacePoint> all_ = surface_points(feet_, stack_);
  FeetTree tree_{feet_, stack_};
};

TEST_F(FeetTreeSearch, FindsTheNearestPointOfEachNode) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-10.0, 10.0);
  FeetTree::Found found;
  int asked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const NodeCube cube{{along(random), along(random), along(random)}, 3.5 * kVoxel};
    constexpr float kMost = 4.0F;
    tree_.collect(cube.center, cube.half, -1.0F, kMost, found);
    const auto points = found_points(found, cube.center);
    for (int corner = 0; corner < 8; ++corner) {
      const double exact = cube.nearest(all_, corner);
      if (exact > static_cast<double>(kMost)) continue;
      ASSERT_NEAR(cube.nearest(points, corner), exact, 1e-4);
      EXPECT_LE(exact, static_cast<double>(found.bound_mm) + 1e-4);
      ++asked;
    }
  }
  EXPECT_GT(asked, 300);
}

TEST_F(FeetTreeSearch, FindsNothingBeyondItsReach) {
  FeetTree::Found found;
  tree_.collect({20.0, 0.0, 0.0}, 1.0, -1.0F, 5.0F, found);
  EXPECT_EQ(found.finest, FeetTree::Found::kNoLevel);
  EXPECT_FALSE(found.is_near);
  FeetTree().collect({}, 1.0, -1.0F, 5.0F, found);
  EXPECT_EQ(found.finest, FeetTree::Found::kNoLevel);
}

TEST_F(FeetTreeSearch, EndsWhereAllNodesAreNearer) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> along(-7.0, 7.0);
  FeetTree::Found found;
  int near = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const NodeCube cube{{along(random), along(random), along(random)}, 3.5 * kVoxel};
    constexpr float kLeast = 2.5F;
    tree_.collect(cube.center, cube.half, kLeast, 6.0F, found);
    if (!found.is_near) continue;
    ++near;
    for (int corner = 0; corner < 8; ++corner) {
      EXPECT_LT(cube.nearest(all_, corner), static_cast<double>(kLeast));
    }
    for (const ClusterList& list : found.lists) EXPECT_TRUE(list.is_empty());
  }
  EXPECT_GT(near, 10);
}

}  // namespace
}  // namespace argil
