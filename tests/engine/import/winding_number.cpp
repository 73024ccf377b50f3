// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/winding_number.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/measure/solid_winding.h"
#include "support/shapes.h"

namespace argil {
namespace {

TriangleMesh wound_box(const Box3& box) { return test::box_mesh(box.size(), box.center()); }

/// The definition, summed with the C library's arc tangent.
double winding_by_sum(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const HalfAngle f = half_solid_angle(mesh.positions[t[0]] - p, mesh.positions[t[1]] - p,
                                         mesh.positions[t[2]] - p);
    sum += std::atan2(f.im, f.re);
  }
  return sum / (2.0 * std::numbers::pi);
}

Vec3 random_place(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return {x, y, coordinate(random)};
}

TEST(PolarAngle, AgreesWithTheLibraryInAllQuadrants) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 p = random_place(random, 3.0);
    ASSERT_NEAR(polar_angle(p.x, p.y), std::atan2(p.y, p.x), 1e-13) << p.x << ' ' << p.y;
  }
  EXPECT_NEAR(polar_angle(-1.0, 0.0), std::numbers::pi, 1e-13);
  EXPECT_NEAR(polar_angle(-1.0, -1e-18), -std::numbers::pi, 1e-13);
  EXPECT_EQ(polar_angle(0.0, 0.0), 0.0);
}

TEST(WindingNumber, IsOneInsideAndZeroOutsideABall) {
  const TriangleMesh ball = test::ball_mesh(10.0, 4, {3, -2, 1});
  const WindingNumber winding(ball.positions, ball.triangles);
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_place(random, 14.0);
    const double r = length(p - Vec3{3, -2, 1});
    if (r < 9.95 || r > 10.0) {
      ASSERT_NEAR(winding.at(p), r < 10.0 ? 1.0 : 0.0, 0.1) << r;
    }
  }
}

TEST(WindingNumber, TreeAgreesWithTheSum) {
  const TriangleMesh cap = test::cut_above(test::ball_mesh(10.0, 5), 2.0);
  const WindingNumber winding(cap.positions, cap.triangles);
  std::mt19937_64 random(3);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_place(random, 15.0);
    worst = std::max(worst, std::abs(winding.at(p) - winding_by_sum(cap, p)));
  }
  EXPECT_LT(worst, 0.1);
  RecordProperty("worst", std::to_string(worst));
}

TEST(WindingNumber, CountsBothOfTwoOverlappingBalls) {
  const TriangleMesh both =
      test::joined(test::ball_mesh(5.0, 3, {-3, 0, 0}), test::ball_mesh(5.0, 3, {3, 0, 0}));
  const WindingNumber winding(both.positions, both.triangles);
  EXPECT_NEAR(winding.at({0, 0, 0}), 2.0, 0.1);
  EXPECT_NEAR(winding.at({-6, 0, 0}), 1.0, 0.1);
  EXPECT_NEAR(winding.at({0, 6, 0}), 0.0, 0.1);
}

TEST(WindingNumber, OfAnInwardShellIsNegative) {
  const TriangleMesh shell = test::inside_out(test::ball_mesh(5.0, 3));
  const WindingNumber winding(shell.positions, shell.triangles);
  EXPECT_NEAR(winding.at({1, 0, 0}), -1.0, 0.1);
}

TEST(WindingNumber, IsAHalfOnTheDiscThatClosesACap) {
  // Seen from the plane of its rim a cap fills half the sphere of directions.
  TriangleMesh cap = test::cut_above(wound_box({{-5, -5, -5}, {5, 5, 5}}), -4.0);
  const WindingNumber winding(cap.positions, cap.triangles);
  for (const double x : {-4.5, 0.0, 3.0}) EXPECT_NEAR(winding.at({x, 1.0, -5.0}), 0.5, 1e-12);
}

TEST(SolidWinding, OfOpenInputIsAsExactAsItsCones) {
  const TriangleMesh cap = test::cut_above(test::ball_mesh(10.0, 6), 2.0);
  const test::SolidWinding winding(cap);
  std::mt19937_64 random(4);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_place(random, 15.0);
    worst = std::max(worst, std::abs(winding.at(p) - winding_by_sum(cap, p)));
  }
  EXPECT_LT(worst, 1e-3);
  RecordProperty("worst", std::to_string(worst));
}

TEST(SolidWinding, OfClosedInputIsAWholeNumber) {
  const TriangleMesh ball = test::ball_mesh(10.0, 5);
  const test::SolidWinding winding(ball);
  EXPECT_EQ(winding.at({1, 2, 3}), 1.0);
  EXPECT_EQ(winding.at({9, 9, 9}), 0.0);
}

TEST(BoundaryCones, CloseEveryPartOfTheBoundaryOnItsOwn) {
  TriangleMesh two = test::joined(test::cut_above(test::ball_mesh(5.0, 3), 0.0),
                                  test::cut_above(test::ball_mesh(5.0, 3, {20, 0, 0}), 0.0));
  const std::size_t before = two.positions.size();
  const std::vector<Triangle> cones = boundary_cones(two.positions, two.triangles);
  EXPECT_EQ(two.positions.size(), before + 2);
  two.triangles.insert(two.triangles.end(), cones.begin(), cones.end());
  EXPECT_TRUE(boundary_cones(two.positions, two.triangles).empty());
  EXPECT_GT(signed_volume(two), 0.0);
}

TEST(WindingNumber, OfNothingIsZero) {
  EXPECT_EQ(WindingNumber({}, {}).at({1, 2, 3}), 0.0);
  EXPECT_EQ(WindingNumber({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}).at({1, 2, 3}), 0.0);
}

}  // namespace
}  // namespace argil
