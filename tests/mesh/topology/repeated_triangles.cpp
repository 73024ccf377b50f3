// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology/repeated_triangles.h"

#include <vector>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

TEST(RepeatedTriangles, AreThoseOnTheVerticesOfAnEarlierOneWhicheverWayRound) {
  TriangleMesh mesh = test::box_mesh({1, 2, 3});
  EXPECT_TRUE(repeated_triangles(mesh).empty());
  const auto [a, b, c] = mesh.triangles[4];
  mesh.triangles.push_back({b, c, a});
  mesh.triangles.push_back(Triangle(mesh.triangles[7]));
  mesh.triangles.push_back({c, b, a});
  mesh.triangles.push_back({a, a, b});  // like nothing else
  EXPECT_EQ(repeated_triangles(mesh), (std::vector<std::uint32_t>{12, 13, 14}));
  EXPECT_TRUE(repeated_triangles({}).empty());
}

}  // namespace
}  // namespace argil::mesh
