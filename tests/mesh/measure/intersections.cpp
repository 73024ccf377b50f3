// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/intersections.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/mesh/compact.h"

#include "measure/flat_fans.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using Dice = std::mt19937;

double between(Dice& dice, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(dice);
}

std::vector<TrianglePair> pairs_of(const TriangleMesh& mesh) {
  return self_intersections(mesh, degenerate_triangles(mesh));
}

/// Each two triangles as a mesh of their own, where only exact predicates decide.
std::vector<TrianglePair> pair_by_pair(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh);
  std::vector<TrianglePair> found;
  for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a) {
    for (std::uint32_t b = a + 1; b < mesh.triangles.size(); ++b) {
      const auto is_left_out = [&](std::uint32_t t) {
        return std::binary_search(flat.begin(), flat.end(), t);
      };
      if (is_left_out(a) || is_left_out(b)) continue;
      const TriangleMesh two =
          only_triangles(mesh, [&](std::size_t t) { return t == a || t == b; });
      if (!self_intersections(two, {}).empty()) found.emplace_back(a, b);
    }
  }
  return found;
}

/// Corners on few lattice points: coplanar overlaps, touches, shared and repeated vertices.
TriangleMesh lattice_soup(Dice& dice, int side, std::size_t count) {
  TriangleMesh mesh;
  for (int n = 0; n < side * side * side; ++n) {
    mesh.positions.push_back(
        {1.0 * (n / (side * side)), 1.0 * (n / side % side), 1.0 * (n % side)});
  }
  const auto vertex = [&] { return static_cast<std::uint32_t>(dice() % mesh.positions.size()); };
  while (mesh.triangles.size() < count) mesh.triangles.push_back({vertex(), vertex(), vertex()});
  return mesh;
}

TriangleMesh shaken(Dice& dice, TriangleMesh mesh, double by) {
  for (Vec3& p : mesh.positions) {
    p += Vec3{between(dice, -by, by), between(dice, -by, by), between(dice, -by, by)};
  }
  return mesh;
}

TEST(SelfIntersectionsProperty, EqualAskingPairByPair) {
  constexpr unsigned kSeed = 3;
  Dice dice(kSeed);
  std::size_t crossing = 0;
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", round " << round);
    const TriangleMesh soup = lattice_soup(dice, 2 + round, 90);
    const TriangleMesh folded = shaken(dice, test::torus_mesh(10.0, 4.0, 12, 7), 0.4 * round);
    for (const TriangleMesh& mesh : {soup, folded}) {
      const auto wanted = pair_by_pair(mesh);
      EXPECT_EQ(pairs_of(mesh), wanted);
      crossing += wanted.size();
    }
  }
  EXPECT_GT(crossing, 1000U);
}

TEST(SelfIntersections, CountWhatLongTrianglesAmongSmallOnesCross) {
  TriangleMesh mesh = test::ball_mesh(10.0, 4);
  // From outside through the whole ball: it crosses the surface where it enters and leaves.
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(),
                        {{-1e4, 0.11, 0.13}, {1e4, 0.12, 0.13}, {1e4, 0.12, 0.14}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const auto pairs = pairs_of(mesh);
  ASSERT_GE(pairs.size(), 2U);
  for (const TrianglePair& pair : pairs) EXPECT_EQ(pair.second, mesh.triangles.size() - 1);
}

TEST(SelfIntersections, AreTheSameAlongWhicheverAxisALargeMeshIsSliced) {
  // More than a slab has.
  TriangleMesh mesh = test::joined(test::ball_mesh(10.0, 7), test::ball_mesh(10.0, 7, {5, 1, 2}));
  ASSERT_GT(mesh.triangles.size(), 200'000U);
  const auto along_x = pairs_of(mesh);
  EXPECT_GT(along_x.size(), 1000U);
  for (Vec3& p : mesh.positions) p = {p.z, p.x, p.y};  // now it is longest along y
  EXPECT_EQ(pairs_of(mesh), along_x);
}

/// A cone around vertex 0 whose rim goes around its axis so many times, in so many triangles each.
TriangleMesh cone(int times, int triangles) {
  TriangleMesh mesh;
  mesh.positions.push_back({});
  const int count = times * triangles;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / triangles;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.3 + 0.1 * i});
    const auto next = static_cast<std::uint32_t>(1 + (i + 1) % count);
    mesh.triangles.push_back({0, static_cast<std::uint32_t>(1 + i), next});
  }
  return mesh;
}

std::vector<std::uint8_t> fans_of(const TriangleMesh& mesh) {
  const Progress nobody;
  return flat_fans(mesh, Pace(nobody, "fans"));
}

TEST(FlatFans, AreThoseThatTurnOnceEitherWay) {
  EXPECT_EQ(fans_of(cone(1, 7))[0], 1);
  EXPECT_EQ(fans_of(test::inside_out(cone(1, 7)))[0], 1);
  EXPECT_EQ(fans_of(cone(2, 7))[0], 0);
  EXPECT_EQ(fans_of(test::inside_out(cone(2, 7)))[0], 0);
}

TEST(FlatFans, AreClosedRingsOnly) {
  EXPECT_EQ(fans_of(test::without(cone(1, 7), 3))[0], 0);
  // Two rings on one vertex, each of them flat.
  TriangleMesh two = cone(1, 7);
  for (const Triangle& t : cone(1, 7).triangles) two.triangles.push_back({0, t[1] + 7, t[2] + 7});
  const TriangleMesh other = cone(1, 7);
  two.positions.insert(two.positions.end(), other.positions.begin() + 1, other.positions.end());
  EXPECT_EQ(fans_of(two)[0], 0);
  TriangleMesh turned = cone(1, 7);
  std::swap(turned.triangles[2][1], turned.triangles[2][2]);
  EXPECT_EQ(fans_of(turned)[0], 0);
}

TEST(FlatFans, AreAllOfASmoothSurface) {
  const std::vector<std::uint8_t> fans = fans_of(test::ball_mesh(10.0, 5));
  EXPECT_EQ(std::count(fans.begin(), fans.end(), 1), static_cast<std::ptrdiff_t>(fans.size()));
}

}  // namespace
}  // namespace argil::mesh
