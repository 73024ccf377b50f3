// SPDX-License-Identifier: GPL-3.0-or-later
// Winding numbers of nodes, and of places between them, against the sum of all solid angles.
#include "import/lattice_winding.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "argil/core/closest_on_triangle.h"
#include "argil/core/winding_number.h"

#include "import/column_winding.h"
#include "support/shapes.h"

namespace argil {
namespace {

double sum_of_angles(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const HalfAngle f = half_solid_angle(mesh.positions[t[0]] - p, mesh.positions[t[1]] - p,
                                         mesh.positions[t[2]] - p);
    sum += std::atan2(f.im, f.re);
  }
  return sum / (2.0 * std::numbers::pi);
}

double distance_of(const TriangleMesh& mesh, const Vec3& p) {
  double least = 1e300;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 foot =
        closest_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    least = std::min(least, length(foot - p));
  }
  return least;
}

template <class Winding>
Winding winding_of(const TriangleMesh& mesh, const Vec3& center, double voxel) {
  TriangleMesh moved = mesh;
  for (Vec3& p : moved.positions) p -= center;
  return {moved.positions, moved.triangles, center, voxel};
}

/// At `count` nodes within the bounds and a little beyond, and at a place beside each, those but
/// for a thousandth of a voxel.
void expect_sums(const TriangleMesh& mesh, double voxel, int count) {
  const Box3 box = bounds(mesh);
  const auto winding = winding_of<LatticeWinding>(mesh, box.center(), voxel);
  const auto columns = winding_of<ColumnWinding>(mesh, box.center(), voxel);
  std::uniform_real_distribution<double> beside(-0.5 * voxel, 0.5 * voxel);
  std::mt19937 dice(7);
  const auto place = [&](std::size_t axis) {
    std::uniform_real_distribution<double> some(box.min[axis] - 2 * voxel,
                                                box.max[axis] + 2 * voxel);
    return static_cast<int>(std::lround(some(dice) / voxel));
  };
  int asked = 0;
  for (int n = 0; n < count; ++n) {
    const int x = place(0);
    const int y = place(1);
    const Coord node(x, y, place(2));
    const Vec3 p = node_mm(node, voxel);
    if (distance_of(mesh, p) < 1e-3 * voxel) continue;
    ++asked;
    ASSERT_NEAR(winding.at(node), sum_of_angles(mesh, p), 1e-6) << node;
    ASSERT_EQ(columns.at(p - box.center()), winding.at(node)) << node;
    const double dx = beside(dice);
    const double dy = beside(dice);
    const Vec3 q = p + Vec3{dx, dy, beside(dice)};
    if (distance_of(mesh, q) < 1e-3 * voxel) continue;
    ASSERT_NEAR(columns.at(q - box.center()), sum_of_angles(mesh, q), 1e-6)
        << q.x << ' ' << q.y << ' ' << q.z;
  }
  EXPECT_GT(asked, count / 2);
}

TEST(LatticeWinding, IsTheSumOfSolidAngles) {
  expect_sums(test::ball_mesh(8.0, 3, {0.31, -0.12, 0.07}), 0.5, 1000);
  expect_sums(test::torus_mesh(8.0, 3.0, 40, 16), 0.3, 1000);
  expect_sums(test::self_crossing_mesh(), 0.4, 500);
}

TEST(LatticeWinding, CountsOverlapsAndInwardShells) {
  const TriangleMesh both =
      test::joined(test::ball_mesh(6.0, 2), test::ball_mesh(6.0, 2, {5, 1, 2}));
  expect_sums(both, 0.5, 1000);
  expect_sums(test::joined(both, test::inside_out(test::ball_mesh(2.0, 2, {2, 0, 0}))), 0.5, 1000);
}

/// Faces, edges and corners on nodes: every tie there is.
TEST(LatticeWinding, HoldsWhereTheMeshLiesOnTheLattice) {
  expect_sums(test::box_mesh({10, 8, 6}), 0.5, 2000);
  expect_sums(test::joined(test::box_mesh({10, 8, 6}), test::box_mesh({10, 8, 6}, {5, 4, 3})), 0.5,
              2000);
  expect_sums(test::ball_mesh(8.0, 0), 0.5, 2000);  // an octahedron: its edges run through nodes
}

TEST(LatticeWinding, HoldsForLongAndTinyTriangles) {
  expect_sums(test::box_mesh({2000.0, 3.0, 3.0}, {0.013, 0.021, 0.034}), 0.5, 2000);
  expect_sums(test::ball_mesh(1.0, 5, {0.01, 0.02, 0.03}), 0.5, 200);
}

TEST(LatticeWinding, HoldsFarFromTheOrigin) {
  expect_sums(test::ball_mesh(8.0, 2, {60000.3, -59999.7, 50000.1}), 0.5, 500);
}

TEST(LatticeWinding, SaysTheSameOfALeafAndOfItsNodes) {
  const TriangleMesh mesh = test::self_crossing_mesh();
  const auto winding = winding_of<LatticeWinding>(mesh, {0.2, 0.1, 0.3}, 0.4);
  int inside = 0;
  for_each_leaf_origin({Coord(-32), Coord(31)}, [&](const Coord& origin) {
    SidesAround sides;
    winding.sides_around(origin, sides);
    std::array<std::int32_t, kLeafNodes> numbers;
    winding.numbers(origin, numbers);
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      ASSERT_EQ(numbers[n], winding.at(node_of(origin, n)));
    }
    for (int row = 0; row < SidesAround::kSide * SidesAround::kSide; ++row) {
      for (int k = 0; k < SidesAround::kSide; ++k) {
        const Coord node =
            origin.offsetBy(row / SidesAround::kSide - 1, row % SidesAround::kSide - 1, k - 1);
        const bool is_inside = (sides.inside[static_cast<std::size_t>(row)] >> k & 1) != 0;
        ASSERT_EQ(is_inside, winding.at(node) > 0) << node;
        inside += is_inside ? 1 : 0;
      }
    }
  });
  EXPECT_GT(inside, 1000);
}

/// A vertex of a neighbour on an edge, closed by a triangle without area: rounded, it is beside the
/// edge, and what lies between has to be told right, too.
TEST(ColumnWinding, IsRightBetweenAnEdgeAndAVertexOnIt) {
  TriangleMesh mesh{{{0, 0, 0}, {10.3, 7.1, 3.7}, {9, 0, 1}, {0, 8, 2}, {3, 3, -9}}, {}, {}};
  mesh.positions.push_back(mesh.positions[0] + 0.3717 * mesh.positions[1]);
  const Vec3 split = mesh.positions.back();
  // A pyramid below two faces that share the edge from 0 to 1; the second one is cut at 5.
  mesh.triangles = {{0, 2, 1}, {0, 5, 3}, {5, 1, 3}, {0, 1, 5},
                    {2, 0, 4}, {1, 2, 4}, {3, 1, 4}, {0, 3, 4}};
  const std::vector<Vec3>& at = mesh.positions;
  const double voxel = 0.5;
  const LatticeWinding lattice(at, mesh.triangles, {}, voxel);
  const ColumnWinding columns(at, mesh.triangles, {}, voxel);
  std::vector<Triangle> without = mesh.triangles;
  without.erase(without.begin() + 3);
  const ColumnWinding open(at, without, {}, voxel);
  int wrong = 0;
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> some(0.0, 1.0);
  for (int n = 0; n < 20000; ++n) {
    // Far above and far below the edge, beside it by as little as positions are rounded.
    Vec3 p = (n % 2 == 0 ? at[0] : split) +
             some(dice) * ((n % 2 == 0 ? split : at[1]) - (n % 2 == 0 ? at[0] : split));
    p.x += (some(dice) - 0.5) * 2e-4 * voxel;
    ASSERT_EQ(columns.at(p + Vec3{0, 0, 20}), 0);
    ASSERT_EQ(columns.at(p - Vec3{0, 0, 20}), 0);
    wrong += open.at(p + Vec3{0, 0, 20}) != 0 ? 1 : 0;
  }
  EXPECT_GT(wrong, 0) << "else nothing is shown";
  EXPECT_EQ(lattice.at(Coord(2, 2, 60)), 0);
}

TEST(LatticeWinding, OfNothingIsZero) {
  const LatticeWinding none({}, {}, {}, 0.5);
  EXPECT_EQ(none.at(Coord(1, 2, 3)), 0);
  EXPECT_EQ(ColumnWinding({}, {}, {}, 0.5).at({1.0, 2.0, 3.0}), 0);
}

}  // namespace
}  // namespace argil
