// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/collapse_folded.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

TEST(CollapseFolded, MendsATriangleThatRoundingFlattened) {
  TriangleMesh mesh = test::ball_mesh(10, 3);
  // Moving one vertex onto its neighbour flattens the two triangles between them.
  const Triangle t = mesh.triangles[100];
  mesh.positions[t[0]] = mesh.positions[t[1]];
  ASSERT_EQ(check_mesh(mesh).degenerate, 2);
  EXPECT_GE(collapse_folded(mesh), 1);
  EXPECT_TRUE(check_mesh(mesh).printable);
  EXPECT_EQ(collapse_folded(mesh), 0);
}

TEST(CollapseFolded, MendsASliverThatCrossesItsNeighbour) {
  TriangleMesh mesh = test::ball_mesh(10, 3);
  const Triangle t = mesh.triangles[100];
  const Vec3 along = mesh.positions[t[1]] - mesh.positions[t[0]];
  mesh.positions[t[0]] += 1.02 * along;  // just past the neighbour: a fold
  const MeshVerdict folded = check_mesh(mesh);
  ASSERT_GT(folded.self_intersections, 0);
  for (int round = 0; round < 4 && collapse_folded(mesh) > 0; ++round) {
  }
  EXPECT_TRUE(check_mesh(mesh).printable);
}

}  // namespace
}  // namespace argil::mesh
