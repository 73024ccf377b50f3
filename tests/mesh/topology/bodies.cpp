// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/bodies.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::inside_out;
using test::joined;

/// Body numbers of a mesh made of balls of `splits` 1, one after the other.
std::vector<std::uint32_t> body_of_each_ball(const TriangleMesh& mesh) {
  const std::size_t each = ball_mesh(1.0, 1).triangles.size();
  const MeshBodies bodies = mesh_bodies(mesh);
  std::vector<std::uint32_t> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % each == 0) found.push_back(bodies.of_triangle[t]);
    EXPECT_EQ(bodies.of_triangle[t], found.back());
  }
  EXPECT_EQ(bodies.count, *std::max_element(found.begin(), found.end()) + 1);
  return found;
}

TEST(MeshBodies, AreNumberedByVolume) {
  const TriangleMesh mesh =
      joined(joined(ball_mesh(1, 1), ball_mesh(3, 1, {9, 0, 0})), ball_mesh(2, 1, {0, 9, 0}));
  EXPECT_THAT(body_of_each_ball(mesh), testing::ElementsAre(2, 0, 1));
}

/// A cavity goes with the innermost shell around it; what lies loose in it is a body.
TEST(MeshBodies, TakeTheirCavities) {
  TriangleMesh mesh = ball_mesh(10, 1);
  mesh = joined(mesh, inside_out(ball_mesh(8, 1)));
  mesh = joined(mesh, ball_mesh(5, 1));
  mesh = joined(mesh, inside_out(ball_mesh(3, 1)));
  mesh = joined(mesh, ball_mesh(1, 1));
  EXPECT_THAT(body_of_each_ball(mesh), testing::ElementsAre(0, 0, 1, 1, 2));
}

/// The box of a ring holds what stands in its hole.
TEST(MeshBodies, TellABoxFromWhatIsInside) {
  const TriangleMesh ring = test::torus_mesh(20, 5, 24, 12);
  const TriangleMesh shell = joined(ball_mesh(4, 1), inside_out(ball_mesh(2, 1)));
  const MeshBodies bodies = mesh_bodies(joined(ring, shell));
  EXPECT_EQ(bodies.count, 2U);
  EXPECT_EQ(bodies.of_triangle.front(), 0U);
  EXPECT_EQ(bodies.of_triangle.back(), 1U);
}

/// The coordinates of every triangle, in their order.
std::vector<std::array<double, 9>> corners(const TriangleMesh& mesh) {
  std::vector<std::array<double, 9>> all;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.positions[a];
    const Vec3 q = mesh.positions[b];
    const Vec3 r = mesh.positions[c];
    all.push_back({p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z});
  }
  return all;
}

TEST(MeshBodies, SplitIntoMeshesOfTheirOwnVertices) {
  const TriangleMesh ball = ball_mesh(3, 1, {9, 0, 0});
  const TriangleMesh mesh = joined(box_mesh({1, 1, 1}), ball);
  const auto parts = split_mesh(mesh, mesh_bodies(mesh).of_triangle);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(corners(parts[0]), corners(ball));
  EXPECT_EQ(parts[0].positions.size(), ball.positions.size());
  EXPECT_EQ(parts[1].positions.size(), 8U);
}

}  // namespace
}  // namespace argil::mesh
