// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/collapse_mesh.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// Collapses what it can, from the lowest half-edge on, until `steps` are done.
void collapse(CollapseMesh& mesh, int steps) {
  std::vector<std::uint32_t> ring;
  for (HalfEdge h = 0; h < mesh.half_edges() && steps > 0; ++h) {
    if (mesh.is_gone(h) || !mesh.can_collapse(h, ring)) continue;
    mesh.collapse(h, 0.5 * (mesh.position(mesh.from(h)) + mesh.position(mesh.to(h))));
    --steps;
  }
  EXPECT_EQ(steps, 0);
}

TEST(CollapseMesh, RefusesWhatIsNotClosedAndTwoManifold) {
  const TriangleMesh ball = test::ball_mesh(5.0, 3);
  EXPECT_TRUE(CollapseMesh::build(ball));
  EXPECT_FALSE(CollapseMesh::build(test::without(ball, 3)));
  TriangleMesh turned = ball;
  std::swap(turned.triangles[7][0], turned.triangles[7][1]);
  EXPECT_FALSE(CollapseMesh::build(turned));
  TriangleMesh pinched = ball;
  for (Triangle& t : pinched.triangles) {
    for (std::uint32_t& v : t) v = v == ball.triangles[0][0] ? ball.triangles.back()[0] : v;
  }
  EXPECT_FALSE(CollapseMesh::build(pinched));
}

TEST(CollapseMesh, StaysClosedAndKnowsWhatVerticesBecame) {
  const TriangleMesh ball = test::ball_mesh(5.0, 3);
  std::optional<CollapseMesh> mesh = CollapseMesh::build(ball);
  ASSERT_TRUE(mesh);
  collapse(*mesh, 20);
  std::vector<std::uint32_t> kept;
  const TriangleMesh left = mesh->mesh(kept);
  EXPECT_EQ(left.triangles.size(), ball.triangles.size() - 40);
  EXPECT_TRUE(CollapseMesh::build(left));
  mesh->shorten_ways();
  for (std::uint32_t v = 0; v < ball.positions.size(); ++v) {
    EXPECT_NE(mesh->any_from(mesh->became(v)), CollapseMesh::kGone);
  }
}

TEST(CollapseMesh, GoesBackVertexByVertex) {
  const TriangleMesh ball = test::ball_mesh(5.0, 3);
  std::optional<CollapseMesh> mesh = CollapseMesh::build(ball);
  ASSERT_TRUE(mesh);
  const CollapseMesh before = *mesh;
  collapse(*mesh, 20);
  for (std::uint32_t v = 0; v < ball.positions.size(); ++v) mesh->restore(v, before);
  std::vector<std::uint32_t> kept;
  const TriangleMesh again = mesh->mesh(kept);
  EXPECT_EQ(again.triangles, ball.triangles);
  EXPECT_EQ(again.positions, ball.positions);
}

}  // namespace
}  // namespace argil::mesh
