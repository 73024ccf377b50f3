// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/part_gaps.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/mesh/triangle_geometry.h"

#include "measure/triangle_distance.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::ball_mesh;
using test::box_mesh;

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p += by;
  return mesh;
}

std::vector<PartGap> gaps_of(const std::vector<TriangleMesh>& parts, double reach = 1.0) {
  const Progress none;
  return part_gaps(parts, reach, Pace(none, "test"));
}

TEST(PartGaps, NameEveryPairThatIsNearTheNearestFirst) {
  const TriangleMesh box = box_mesh({10, 10, 10});
  const auto gaps = gaps_of({box, moved(box, {10.5, 0, 0}), moved(box, {0, 10.25, 0}),
                             moved(box, {0, 0, 11.5}), moved(box, {-20, 0, 0})});
  ASSERT_EQ(gaps.size(), 3U);
  EXPECT_EQ(gaps[0].a, 0U);
  EXPECT_EQ(gaps[0].b, 2U);
  EXPECT_EQ(gaps[0].gap_mm, 0.25);
  EXPECT_NEAR(gaps[0].at_mm.y, 5.125, 1e-12);
  EXPECT_EQ(gaps[1].b, 1U);
  EXPECT_EQ(gaps[1].gap_mm, 0.5);
  // Across the edges of two that are both near a third.
  EXPECT_EQ(gaps[2].a, 1U);
  EXPECT_EQ(gaps[2].b, 2U);
  EXPECT_NEAR(gaps[2].gap_mm, std::hypot(0.5, 0.25), 1e-12);
}

TEST(PartGaps, AreNothingWherePartsMeetOrCross) {
  const TriangleMesh box = box_mesh({10, 10, 10});
  for (const double x : {10.0, 9.0, 3.0}) {
    const auto gaps = gaps_of({box, moved(box, {x, 1, 2})});
    ASSERT_EQ(gaps.size(), 1U) << x;
    EXPECT_EQ(gaps[0].gap_mm, 0.0) << x;
    EXPECT_TRUE(gaps[0].meet());
    EXPECT_FALSE(gaps[0].is_within);
    EXPECT_LE(std::abs(gaps[0].at_mm.x), 5.0 + x) << x;
  }
  EXPECT_EQ(gaps_of({box, box}).size(), 1U);
}

TEST(PartGaps, KnowWhatLiesInTheSolidOrInACavity) {
  const TriangleMesh inner = box_mesh({2, 2, 2});
  TriangleMesh shell = box_mesh({40, 40, 40});
  const auto within = gaps_of({inner, shell});
  ASSERT_EQ(within.size(), 1U);
  EXPECT_TRUE(within[0].is_within);
  EXPECT_EQ(within[0].gap_mm, 0.0);
  // With a cavity around it, its walls are what is near.
  TriangleMesh cavity = box_mesh({3, 3, 3});
  for (const auto& [a, b, c] : cavity.triangles) shell.triangles.push_back({a + 8, c + 8, b + 8});
  shell.positions.insert(shell.positions.end(), cavity.positions.begin(), cavity.positions.end());
  const auto loose = gaps_of({inner, shell});
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_FALSE(loose[0].is_within);
  EXPECT_NEAR(loose[0].gap_mm, 0.5, 1e-12);
}

TEST(PartGaps, BetweenEdgesAreFoundWhereNoCornerIsNear) {
  // Two rods across each other: only their edges come near.
  TriangleMesh along = box_mesh({100, 1, 1});
  TriangleMesh across = moved(box_mesh({1, 100, 1}), {0, 0, 1.125});
  const auto gaps = gaps_of({along, across});
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_EQ(gaps[0].gap_mm, 0.125);
  EXPECT_LE(std::abs(gaps[0].at_mm.x), 0.5);
  EXPECT_LE(std::abs(gaps[0].at_mm.y), 0.5);
}

/// Distances of balls of many triangles, against all pairs of them.
TEST(PartGapsProperty, EqualMeasuringEveryPairOfTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const Vec3 way = normalized(Vec3{anywhere(random), anywhere(random), anywhere(random) + 1.5});
    const TriangleMesh a = ball_mesh(5.0, 2);
    const TriangleMesh b = moved(ball_mesh(4.0, 2), (9.3 + 0.2 * anywhere(random)) * way);
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.triangles.size(); ++i) {
      for (std::size_t j = 0; j < b.triangles.size(); ++j) {
        nearest2 = std::min(nearest2, closest_points(corners_of(a, i), corners_of(b, j)).distance2);
      }
    }
    const auto gaps = gaps_of({a, b}, 2.0);
    ASSERT_EQ(gaps.size(), 1U) << "round " << round;
    EXPECT_EQ(gaps[0].gap_mm, std::sqrt(nearest2)) << "round " << round;
  }
}

/// Against points spread over both triangles, which can only be farther apart.
TEST(TriangleDistanceProperty, IsNoMoreThanBetweenAnyTwoPointsAndNearlyOfSome) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  const auto corner = [&] { return Vec3{anywhere(random), anywhere(random), anywhere(random)}; };
  constexpr int kSteps = 24;
  const auto spread = [](const Corners& t) {
    std::vector<Vec3> points;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        points.push_back(t[0] + (1.0 * i / kSteps) * (t[1] - t[0]) +
                         (1.0 * j / kSteps) * (t[2] - t[0]));
      }
    }
    return points;
  };
  for (int round = 0; round < 60; ++round) {
    Corners a{corner(), corner(), corner()};
    Corners b{corner(), corner(), corner()};
    if (round % 5 == 1) b[2] = b[1];  // a segment
    if (round % 5 == 2) a = {a[0], a[0], a[0]};
    for (Vec3& p : b) p.x += 0.05 * round;
    const ClosestPoints found = closest_points(a, b);
    double least = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> of_b = spread(b);
    for (const Vec3& p : spread(a)) {
      for (const Vec3& q : of_b) least = std::min(least, length(p - q));
    }
    EXPECT_LE(std::sqrt(found.distance2), least + 1e-12) << "round " << round;
    EXPECT_GE(std::sqrt(found.distance2), least - 0.2) << "round " << round;
    EXPECT_NEAR(length(found.a - found.b), std::sqrt(found.distance2), 1e-12);
  }
}

TEST(PartGaps, StopWhenAskedTo) {
  const Progress stop = [](std::string_view, double) { return false; };
  const std::vector<TriangleMesh> parts{box_mesh({1, 1, 1}), box_mesh({1, 1, 1})};
  EXPECT_THROW(part_gaps(parts, 1.0, Pace(stop, "test")), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
