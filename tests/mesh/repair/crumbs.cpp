// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/crumbs.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

TriangleMesh ball_and_flake() {
  return test::joined(test::ball_mesh(10.0, 3), test::box_mesh({0.2, 0.2, 0.004}, {12, 0, 0}));
}

TEST(Crumbs, GoWhereMendingMadeThem) {
  TriangleMesh mesh = ball_and_flake();
  EXPECT_EQ(drop_crumbs(mesh, test::ball_mesh(10.0, 3)), 1);
  EXPECT_EQ(mesh.triangles.size(), test::ball_mesh(10.0, 3).triangles.size());
}

TEST(Crumbs, AreNotWhatWasGiven) {
  TriangleMesh mesh = ball_and_flake();
  EXPECT_EQ(drop_crumbs(mesh, mesh), 0);
  EXPECT_EQ(mesh.triangles, ball_and_flake().triangles);
}

TEST(Crumbs, AreNotThickNorLarge) {
  TriangleMesh mesh =
      test::joined(test::ball_mesh(10.0, 3), test::box_mesh({0.1, 0.1, 0.1}, {12, 0, 0}));
  EXPECT_EQ(drop_crumbs(mesh, {}), 0);
}

}  // namespace
}  // namespace argil::mesh
