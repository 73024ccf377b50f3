// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/triangle_mesh.h"

#include <utility>

#include <gtest/gtest.h>

namespace argil {
namespace {

/// A box with one corner at `low`, faces outward.
TriangleMesh box_mesh(const Vec3& low, const Vec3& size) {
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner) {
    mesh.positions.push_back(low + Vec3{(corner & 1U) != 0 ? size.x : 0.0,
                                        (corner & 2U) != 0 ? size.y : 0.0,
                                        (corner & 4U) != 0 ? size.z : 0.0});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(TriangleMesh, KnowsVolumeAndAreaOfABox) {
  const TriangleMesh mesh = box_mesh({1, 2, 3}, {2, 3, 4});
  EXPECT_NEAR(signed_volume(mesh), 24.0, 1e-12);
  EXPECT_NEAR(surface_area(mesh), 2.0 * (6.0 + 8.0 + 12.0), 1e-12);
}

TEST(TriangleMesh, KeepsItsVolumeFarFromTheOrigin) {
  EXPECT_NEAR(signed_volume(box_mesh({1e6, -1e6, 1e6}, {2, 3, 4})), 24.0, 1e-7);
}

TEST(TriangleMesh, HasNegativeVolumeInsideOut) {
  TriangleMesh mesh = box_mesh({}, {1, 1, 1});
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(signed_volume(mesh), -1.0, 1e-14);
}

TEST(TriangleMesh, BoundsAllPositionsUsedOrNot) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.positions.push_back({-5, 0.5, 0.5});
  EXPECT_EQ(bounds(mesh).min, (Vec3{-5, 0, 0}));
  EXPECT_EQ(bounds(mesh).max, (Vec3{1, 1, 1}));
}

TEST(TriangleMesh, IsNothingWhenEmpty) {
  EXPECT_TRUE(bounds(TriangleMesh{}).empty());
  EXPECT_EQ(signed_volume(TriangleMesh{}), 0.0);
  EXPECT_EQ(surface_area(TriangleMesh{}), 0.0);
}

}  // namespace
}  // namespace argil
