// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a Clay follows its strokes and its undo without extracting everything.
#include "argil/engine/surface.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

Clay make_ball(double radius_mm) {
  auto made = Clay::ball(radius_mm, ClayOptions{.voxel_mm = 0.25});
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

/// At the top of a ball.
Stroke fine_carve(double radius_mm = 20.0) {
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {2.0, 2.0, 2.0};
  for (int i = 0; i < 3; ++i) {
    StrokeSample sample;
    sample.time_s = 0.1 * i;
    sample.position_mm = {2.0 * i - 2.0, 0.5, radius_mm + 0.3};
    stroke.samples.push_back(sample);
  }
  return stroke;
}

void expect_fresh(const Surface& kept, const Clay& clay) {
  const TriangleMesh mesh = kept.weld();
  const TriangleMesh fresh = extract_surface(clay);
  EXPECT_EQ(mesh.triangles, fresh.triangles);
  EXPECT_EQ(mesh.positions, fresh.positions);
  EXPECT_EQ(mesh.normals, fresh.normals);
  EXPECT_EQ(find_mesh_faults(mesh), MeshFaults{});
  EXPECT_EQ(euler_characteristic(mesh), 2);
}

TEST(SurfaceOfClay, FollowsAStrokeAndItsUndo) {
  Clay clay = make_ball(20.0);
  Surface surface;
  const std::int64_t all = surface.update(clay);
  expect_fresh(surface, clay);
  const TriangleMesh before = surface.weld();
  ASSERT_TRUE(clay.apply(fine_carve()).ok());
  surface.update(clay);
  EXPECT_NE(surface.weld().positions, before.positions);
  expect_fresh(surface, clay);
  ASSERT_TRUE(clay.undo());
  surface.update(clay);
  expect_fresh(surface, clay);
  EXPECT_EQ(surface.weld().positions, before.positions);
  EXPECT_EQ(surface.update(clay), 0);
  EXPECT_GT(all, 0);
}

/// However many changes there have been: the log forgets the oldest, and who looks after each edit
/// misses none.
TEST(SurfaceOfClay, NeverStartsAnewWhileItIsBroughtUpToDateAfterEveryEdit) {
  Clay clay = make_ball(40.0);
  Surface surface;
  ASSERT_TRUE(clay.apply(fine_carve(40.0)).ok());
  const std::int64_t all = surface.update(clay);
  std::int64_t most = 0;
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(i % 2 == 0 ? clay.undo() : clay.redo());
    most = std::max(most, surface.update(clay));
  }
  EXPECT_GT(most, 0);
  EXPECT_LT(2 * most, all);
  expect_fresh(surface, clay);
}

TEST(SurfaceOfClay, StartsAnewWithAnotherClay) {
  const Clay large = make_ball(20.0);
  const Clay small = make_ball(7.0);
  Surface surface;
  surface.update(large);
  surface.update(small);
  expect_fresh(surface, small);
}

/// Vertices may lie off their edges (docs/surface.md), so that no proof says that triangles do not
/// cross: whatever strokes leave behind is to be tried.
TEST(SurfaceOfClay, OfSculpturesIsClosedAndFreeOfCrossings) {
  constexpr int kDabs = 40;
  std::int64_t triangles = 0;
  for (int seed = 0; seed < effort(6, 200); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    Clay clay = random_start(random);
    for (int i = 0; i < kDabs; ++i) {
      const Stroke dab = random_dab(random, 10.0);
      ASSERT_TRUE(clay.apply(dab).ok()) << describe(dab);
    }
    const TriangleMesh mesh = extract_surface(clay);
    triangles += static_cast<std::int64_t>(mesh.triangles.size());
    EXPECT_EQ(find_mesh_faults(mesh), MeshFaults{});
    EXPECT_EQ(find_soup_faults(mesh), SoupFaults{});
    EXPECT_EQ(find_soup_faults(rounded_to_float(mesh, {100.0, -90.0, 110.0})), SoupFaults{});
  }
  EXPECT_GT(triangles, 10'000);
}

}  // namespace
}  // namespace argil::test
