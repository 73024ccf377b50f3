// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of nodes against those to every triangle in doubles.
#include "import/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "argil/engine/mesh_distance.h"

#include "support/shapes.h"

namespace argil {
namespace {

struct Measured {
  std::map<Coord, std::array<float, kLeafNodes>> leaves;
};

ImportInput input_of(const TriangleMesh& mesh, double voxel_mm) {
  auto input = prepare_import(mesh, {voxel_mm, 0.1});
  EXPECT_TRUE(input.ok()) << (input.ok() ? "" : input.error().message);
  return std::move(input).value();
}

Measured measured(const ImportInput& input) {
  Measured all;
  const Scatter scatter(input);
  for (std::size_t brick = 0; brick < scatter.bricks(); ++brick) {
    scatter.measure(brick, [&](const Coord& origin, const float* squares) {
      std::copy_n(squares, kLeafNodes, all.leaves[origin].begin());
    });
  }
  return all;
}

/// The largest error in voxels; every leaf that is beside one that was measured is asked too.
double worst_error(const TriangleMesh& mesh, double voxel_mm) {
  const ImportInput input = input_of(mesh, voxel_mm);
  const Measured all = measured(input);
  EXPECT_FALSE(all.leaves.empty());
  const MeshDistance exact(input.positions, input.triangles);
  const double band = kHalfWidthVoxels;
  double worst = 0.0;
  std::size_t nodes = 0;
  std::map<Coord, int> asked;
  for (const auto& [origin, squares] : all.leaves) {
    for_each_leaf_origin({origin.offsetBy(-8), origin.offsetBy(8)},
                         [&](const Coord& at) { asked[at] = 1; });
  }
  const std::size_t stride = 1 + asked.size() / 300;  // of all nodes of all leaves some 150 000
  for (const auto& [origin, unused] : asked) {
    const auto found = all.leaves.find(origin);
    for (std::size_t n = nodes++ % stride; n < kLeafNodes; n += stride) {
      const Vec3 p = node_mm(node_of(origin, n), voxel_mm) - input.center;
      const double d = exact.closest(p, band * voxel_mm).distance / voxel_mm;
      const double square = found == all.leaves.end() ? band * band : double{found->second[n]};
      worst = std::max(worst, std::abs(std::sqrt(square) - d));
    }
  }
  return worst;
}

constexpr double kExact = 5e-6;  // what scatter.h promises

TEST(Scatter, IsExactForTrianglesOfTheVoxelsSize) {
  EXPECT_LT(worst_error(test::ball_mesh(6.0, 4, {0.11, 0.23, 0.37}), 0.5), kExact);
}

TEST(Scatter, IsExactForTrianglesMuchFinerThanVoxels) {
  EXPECT_LT(worst_error(test::ball_mesh(6.0, 6, {0.11, 0.23, 0.37}), 1.0), kExact);
  EXPECT_LT(worst_error(test::torus_mesh(5.0, 2.0, 400, 200), 0.8), kExact);
}

TEST(Scatter, IsExactForTrianglesMuchLargerThanLeaves) {
  EXPECT_LT(worst_error(test::box_mesh({900.0, 40.0, 3.0}, {0.13, 0.21, 0.34}), 0.5), kExact);
  TriangleMesh turned = test::box_mesh({400.0, 30.0, 20.0});
  for (Vec3& p : turned.positions) {
    p = rotate(normalized(Quat{0.9, 0.2, -0.3, 0.25}), p);
  }
  EXPECT_LT(worst_error(turned, 0.5), kExact);
}

TEST(Scatter, IsZeroAtNodesOfFacesOnTheLattice) {
  const ImportInput input = input_of(test::box_mesh({10, 8, 6}, {5, 4, 3}), 0.5);
  const Measured all = measured(input);
  int on = 0;
  for (const auto& [origin, squares] : all.leaves) {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      const Coord node = node_of(origin, n);
      const bool is_within = node.x() >= 0 && node.x() <= 20 && node.y() > 0 && node.y() < 16 &&
                             node.z() > 0 && node.z() < 12;
      if (!is_within || (node.x() != 0 && node.x() != 20)) continue;
      EXPECT_EQ(squares[n], 0.0F) << node;
      ++on;
    }
  }
  EXPECT_EQ(on, 2 * 15 * 11);
}

TEST(Scatter, IsExactFarFromTheOrigin) {
  EXPECT_LT(worst_error(test::ball_mesh(6.0, 3, {60000.2, -59999.9, 1234.5}), 0.5), kExact);
}

/// Needles, slivers and specks: no height, no length, all at once.
TEST(Scatter, IsExactForTrianglesOfNearlyNoArea) {
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> some(-10.0, 10.0);
  TriangleMesh mesh;
  const auto random_place = [&] {
    const double x = some(dice);
    const double y = some(dice);
    return Vec3{x, y, some(dice)};
  };
  for (int n = 0; n < 200; ++n) {
    const Vec3 a = random_place();
    const Vec3 b = n % 3 == 0 ? a + random_place() * 1e-7 : random_place();
    const Vec3 along = n % 3 == 1 ? a + (b - a) * 0.37 : b;
    const Vec3 c = along + random_place() * std::pow(10.0, -(n % 14));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_LT(worst_error(mesh, 0.5), kExact);
}

}  // namespace
}  // namespace argil
