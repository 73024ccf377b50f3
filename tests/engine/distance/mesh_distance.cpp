// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/mesh_distance.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "argil/core/closest_on_triangle.h"

namespace argil {
namespace {

/// Needles through one place, which the tree has in pieces, and a triangle without area.
TriangleMesh needles(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  TriangleMesh mesh;
  for (int n = 0; n < count; ++n) {
    const Vec3 along = normalized(Vec3{number(random), number(random), number(random)});
    const Vec3 side = normalized(cross(along, {0.3, 0.5, number(random)}));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : {50.0 * along, -50.0 * along, 50.0 * along + 0.5 * side}) {
      mesh.positions.push_back(p);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.triangles.push_back({0, 0, 0});
  return mesh;
}

TEST(MeshDistance, OfLongTrianglesIsThatOfTheNearest) {
  const TriangleMesh mesh = needles(300);
  const MeshDistance distance(mesh.positions, mesh.triangles);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-40.0, 40.0);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p{number(random), number(random), number(random)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 on =
          closest_on_triangle(p, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
      nearest = std::min(nearest, length(on - p));
    }
    const auto found = distance.closest(p, std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(found.distance, nearest);
    ASSERT_LT(found.triangle, mesh.triangles.size());
  }
}

}  // namespace
}  // namespace argil
