// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/dense_error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "support/measure/triangle_buckets.h"

namespace argil {
namespace {

Clay small_ball_of_clay() {
  ClayOptions options;
  options.voxel_mm = 0.2;
  return Clay::ball(2.0, options).value();
}

TEST(TriangleBucketsProperty, SayWhatAllTrianglesSay) {
  const TriangleMesh mesh = extract_surface(small_ball_of_clay());
  const test::TriangleBuckets buckets(mesh, 0.7);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p{place(random), place(random), place(random)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      nearest = std::min(
          nearest, test::distance_to(p, {mesh.positions[a], mesh.positions[b], mesh.positions[c]}));
    }
    EXPECT_EQ(buckets.distance(p), nearest) << n;
  }
}

TEST(DenseError, SeesADentOfOneVertexBothWays) {
  const Clay clay = small_ball_of_clay();
  const TriangleMesh surface = extract_surface(clay);
  const double good = test::dense_error(surface, surface, clay, 0.05).max_mm();
  TriangleMesh dented = surface;
  dented.positions[100] *= 0.9;  // by 0.2 mm, a voxel
  const mesh::MeshError error = test::dense_error(dented, surface, clay, 0.05);
  EXPECT_LT(good, 0.01);
  EXPECT_NEAR(error.mesh_to_field.max_mm, 0.2, 0.005);
  // From above the dent the way is to its sides.
  EXPECT_GT(error.field_to_mesh.max_mm, 0.08);
  EXPECT_LT(error.field_to_mesh.max_mm, 0.2);
}

}  // namespace
}  // namespace argil
