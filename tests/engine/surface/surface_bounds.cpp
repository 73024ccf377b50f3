// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/operation.h"
#include "argil/engine/surface.h"

#include "support/stroke_maker.h"

namespace argil {
namespace {

Box3 box_of_mesh(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return box;
}

/// After strokes that leave fine leaves on coarse ones anywhere, and cuts through all of it.
TEST(SurfaceBounds, AreThoseOfTheWholeSurface) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    Clay clay = Clay::ball(6.0, {0.25, 0.1}).value();
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(clay.apply(random_dab(random, 6.0)));
    if (seed % 2 == 0) {
      ASSERT_TRUE(clay.apply(Operation(Cut{{0.3, 0.1, 1.0}, {0.1, 0.2, 1.0}, false})));
    }
    const Box3 wanted = box_of_mesh(extract_surface(clay));
    const Box3 box = surface_bounds_mm(clay);
    EXPECT_EQ(box.min, wanted.min) << seed;
    EXPECT_EQ(box.max, wanted.max) << seed;
  }
}

}  // namespace
}  // namespace argil
