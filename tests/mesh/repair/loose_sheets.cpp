// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/loose_sheets.h"

#include <gtest/gtest.h>

#include "argil/mesh/repair.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// A ball with a triangle missing, and small squares beside it.
TriangleMesh ball_and_sheets(int sheets) {
  TriangleMesh mesh = test::without(test::ball_mesh(10.0, 3), 5);
  for (int i = 0; i < sheets; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 at{20.0 + 3.0 * (i % 10), 3.0 * (i / 10), 0.0};
    for (const Vec3& p : {Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
      mesh.positions.push_back(at + p);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

TEST(LooseSheets, GoHoweverManyTheyAre) {
  const auto mended = mend_mesh(ball_and_sheets(100));
  ASSERT_TRUE(mended) << mended.error().message;
  EXPECT_EQ(mended.value().report.dropped_sheets, 100);
  EXPECT_TRUE(mended.value().report.verdict.printable);
}

TEST(LooseSheets, HearThatTheyShallStop) {
  const Progress stop = [](std::string_view, double) { return false; };
  TriangleMesh mesh = ball_and_sheets(3);
  EXPECT_THROW(drop_loose_sheets(mesh, Pace(stop, "")), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
