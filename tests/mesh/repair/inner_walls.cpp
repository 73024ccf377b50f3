// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/inner_walls.h"

#include <utility>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// A box with a wall across its middle.
TriangleMesh walled_box() {
  TriangleMesh mesh;
  for (const double z : {0.0, 5.0, 10.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}}) {
      mesh.positions.push_back({x, y, z});
    }
  }
  for (const std::uint32_t low : {0U, 4U}) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = low + k;
      const std::uint32_t b = low + (k + 1) % 4;
      mesh.triangles.push_back({a, b, b + 4});
      mesh.triangles.push_back({a, b + 4, a + 4});
    }
  }
  for (const Triangle& t :
       {Triangle{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {8, 9, 10}, {8, 10, 11}}) {
    mesh.triangles.push_back(t);
  }
  return mesh;
}

TEST(InnerWalls, GoFromAcrossAShell) {
  const Progress nobody;
  TriangleMesh mesh = walled_box();
  EXPECT_EQ(drop_inner_walls(mesh, Pace(nobody, "")), 2);
  EXPECT_EQ(mesh.triangles.size(), 20U);
}

TEST(InnerWalls, HearThatTheyShallStop) {
  const Progress stop = [](std::string_view, double) { return false; };
  TriangleMesh mesh = walled_box();
  EXPECT_THROW(drop_inner_walls(mesh, Pace(stop, "")), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
