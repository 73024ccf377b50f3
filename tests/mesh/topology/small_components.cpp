// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/small_components.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "argil/mesh/check.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// A ball between two specks, of a millimetre's side and less.
TriangleMesh ball_and_specks() {
  const TriangleMesh specks = test::joined(test::box_mesh({0.5, 0.5, 0.5}, {5, 0, 0}),
                                           test::box_mesh({0.2, 0.3, 0.4}, {0, 5, 0}));
  return test::joined(test::joined(specks, test::ball_mesh(3.0, 3)),
                      test::box_mesh({0.9, 0.9, 0.9}, {0, 0, 5}));
}

TEST(SmallComponents, GoBackOneByOne) {
  TriangleMesh mesh = ball_and_specks();
  const TriangleMesh all = mesh;
  SmallComponents small = drop_small_components(mesh, 1.0);
  ASSERT_EQ(small.count, 3);
  ASSERT_EQ(small.mesh.positions.size(), 24U);
  EXPECT_EQ(check_mesh(mesh).components, 1);
  // The second, which two of the vertices name.
  const std::array<std::uint32_t, 2> second{9, 12};
  EXPECT_EQ(put_back(mesh, small, second), 1);
  EXPECT_EQ(small.count, 2);
  EXPECT_EQ(small.mesh.triangles.size(), 24U);
  EXPECT_EQ(check_mesh(mesh).components, 2);
  EXPECT_NEAR(signed_volume(mesh) + signed_volume(small.mesh), signed_volume(all), 1e-12);
  EXPECT_NEAR(signed_volume(small.mesh), 0.125 + 0.729, 1e-12);
  EXPECT_EQ(put_back(mesh, small, {}), 0);
  const std::array<std::uint32_t, 2> rest{0, 15};
  EXPECT_EQ(put_back(mesh, small, rest), 2);
  EXPECT_EQ(small.count, 0);
  EXPECT_TRUE(small.mesh.triangles.empty());
  EXPECT_EQ(mesh.triangles.size(), all.triangles.size());
  EXPECT_NEAR(signed_volume(mesh), signed_volume(all), 1e-12);
}

}  // namespace
}  // namespace argil::mesh
