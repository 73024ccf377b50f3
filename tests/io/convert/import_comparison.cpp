// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/import_comparison.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"

#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::joined;

PreparedMesh prepared(const TriangleMesh& mesh) {
  const test::ScratchFolder folder;
  EXPECT_TRUE(write_mesh(folder / "m.obj", mesh));
  return read_prepared_mesh(folder / "m.obj").value();
}

ImportComparison imported_and_compared(const TriangleMesh& mesh, double voxel_mm) {
  const PreparedMesh given = prepared(mesh);
  const auto imported = import_mesh(given.mesh, {voxel_mm, 0.1});
  EXPECT_TRUE(imported) << imported.error().message;
  const auto& [clay, report] = imported.value();
  const auto compared = compare_import(given, clay, extract_surface(clay), report.winding_bridged);
  EXPECT_TRUE(compared) << compared.error().message;
  return compared.value();
}

/// The same turned askew to the lattice.
TriangleMesh askew(TriangleMesh mesh) {
  const Quat turn = normalized(Quat{0.9, 0.2, 0.3, 0.1});
  for (Vec3& p : mesh.positions) p = rotate(turn, p);
  return mesh;
}

/// Two boxes of 5 mm a face apart; the gap is from x = 0.2.
TriangleMesh two_boxes(double gap_mm) {
  return joined(box_mesh({5.0, 5.0, 5.0}, {-2.3, 0.0, 0.0}),
                box_mesh({5.0, 5.0, 5.0}, {2.7 + gap_mm, 0.0, 0.0}));
}

struct Honest {
  std::string name;
  TriangleMesh mesh;
  std::int64_t bodies = 1;
};

std::vector<Honest> honest() {
  return {{"ball", ball_mesh(10.0, 4)},
          {"box on the lattice", box_mesh({10.0, 10.0, 10.0})},
          {"box askew", askew(box_mesh({10.0, 9.0, 8.0}))},
          {"shell", joined(ball_mesh(10.0, 4), test::inside_out(ball_mesh(6.0, 4)))},
          {"apart", askew(two_boxes(3.0)), 2}};
}

TEST(ImportComparison, FindsNothingAmissInHonestClay) {
  constexpr double kComparedVoxelMm = 0.5;
  constexpr double kMost = ImportComparison::kMostVoxelsOff * kComparedVoxelMm;
  for (const auto& [name, mesh, bodies] : honest()) {
    SCOPED_TRACE(name);
    const ImportComparison found = imported_and_compared(mesh, kComparedVoxelMm);
    EXPECT_LE(found.extent_off_mm, kMost);
    EXPECT_LE(found.lost.distance_mm, kMost);
    EXPECT_LE(found.filled.distance_mm, kMost);
    EXPECT_LE(found.added.distance_mm, kMost);
    ASSERT_TRUE(found.given_volume_mm3);
    EXPECT_NEAR(found.volume_mm3 / *found.given_volume_mm3, 1.0, found.volume_margin);
    EXPECT_FALSE(found.has_inner_walls);
    EXPECT_EQ(found.bodies, bodies);
    EXPECT_EQ(found.given_bodies, bodies);
    EXPECT_TRUE(found.fused.empty());
  }
}

/// A node on each side, none within: the field around says that the gap is near, and is one solid.
TEST(ImportComparison, SeesAGapThatNoNodeHit) {
  constexpr double kGapMm = 0.1;
  const ImportComparison found = imported_and_compared(two_boxes(kGapMm), 0.5);
  EXPECT_GT(found.filled.distance_mm, 1.5);
  EXPECT_NEAR(found.filled.at_mm.x, 0.25, 0.051);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.given_bodies, 2);
  ASSERT_EQ(found.fused.size(), 1U);
  EXPECT_NEAR(found.fused[0].gap_mm, kGapMm, 1e-6);
  EXPECT_NEAR(found.fused[0].at_mm.x, 0.25, 1e-6);
  EXPECT_EQ(found.part_names, (std::vector<std::string>{"body 1", "body 2"}));
  EXPECT_FALSE(found.has_inner_walls);
}

/// Askew, nodes in the gap leave holes everywhere, so that no point is far from a surface.
TEST(ImportComparison, SeesBodiesThatMergedAcrossAGapFullOfHoles) {
  const ImportComparison found = imported_and_compared(askew(two_boxes(0.2)), 0.3);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.given_bodies, 2);
  ASSERT_EQ(found.fused.size(), 1U);
  EXPECT_NEAR(found.fused[0].gap_mm, 0.2, 1e-6);
}

TEST(ImportComparison, TakesPartsThatOverlapForOneBody) {
  const TriangleMesh mesh = joined(ball_mesh(5.0, 4), ball_mesh(4.0, 4, {4.0, 0.5, 0.2}));
  const ImportComparison found = imported_and_compared(mesh, 0.25);
  EXPECT_TRUE(found.has_inner_walls);
  EXPECT_LE(found.filled.distance_mm, ImportComparison::kMostVoxelsOff * 0.25);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.given_bodies, 2);
  EXPECT_TRUE(found.fused.empty());
}

/// So little that no point that is looked at lies within both.
TEST(ImportComparison, TakesPartsThatHardlyOverlapForOneBodyToo) {
  const TriangleMesh mesh = joined(ball_mesh(10.0, 4), ball_mesh(10.0, 4, {19.95, 0.0, 0.0}));
  const ImportComparison found = imported_and_compared(mesh, 0.5);
  EXPECT_EQ(found.bodies, 1);
  EXPECT_EQ(found.given_bodies, 2);
  EXPECT_TRUE(found.fused.empty());
}

TEST(ImportComparison, SaysHowMuchIsLostWhereNothingIsLeft) {
  const PreparedMesh given = prepared(box_mesh({12.0, 12.0, 6.0}));
  const Clay clay = import_mesh(given.mesh, {0.5, 0.1}).value().clay;
  const auto found = compare_import(given, clay, {}, false);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_DOUBLE_EQ(found.value().lost.distance_mm, 12.0);
  EXPECT_DOUBLE_EQ(found.value().extent_off_mm, 12.0);
}

TEST(ImportComparison, SeesASheetThatNoNodeHit) {
  const TriangleMesh mesh =
      joined(box_mesh({4.0, 4.0, 4.0}), box_mesh({12.0, 12.0, 0.1}, {0.0, 0.0, 0.25}));
  const ImportComparison found = imported_and_compared(mesh, 0.5);
  EXPECT_GT(found.lost.distance_mm, 3.0);
  EXPECT_NEAR(found.lost.at_mm.z, 0.25, 0.051);
  EXPECT_GT(found.extent_off_mm, 3.0);
}

TEST(ImportComparison, SeesASurfaceThatTheMeshHasNot) {
  const PreparedMesh given = prepared(ball_mesh(5.0, 4));
  const Clay clay = std::move(Clay::ball(8.0, ClayOptions{.voxel_mm = 0.5}).value());
  const auto compared = compare_import(given, clay, extract_surface(clay), false);
  ASSERT_TRUE(compared) << compared.error().message;
  const ImportComparison& found = compared.value();
  EXPECT_NEAR(found.added.distance_mm, 3.0, 0.1);
  EXPECT_NEAR(length(found.added.at_mm), 8.0, 0.1);
  EXPECT_NEAR(found.filled.distance_mm, 3.0, 0.1);
  EXPECT_NEAR(found.extent_off_mm, 3.0, 0.1);
  EXPECT_EQ(found.lost.distance_mm, 0.0);
}

/// Far from all that was given, and told of already.
TEST(ImportComparison, ExpectsWhatARepairAdded) {
  const PreparedMesh given = prepared(test::cut_above(ball_mesh(10.0, 4), -5.0));
  ASSERT_EQ(given.closing.holes_closed, 1);
  const auto imported = import_mesh(given.mesh, {0.5, 0.1});
  ASSERT_TRUE(imported) << imported.error().message;
  const auto compared =
      compare_import(given, imported.value().clay, extract_surface(imported.value().clay), false);
  ASSERT_TRUE(compared) << compared.error().message;
  EXPECT_LE(compared.value().added.distance_mm, 0.75);
  EXPECT_LE(compared.value().extent_off_mm, 0.75);
  EXPECT_FALSE(compared.value().given_volume_mm3);
}

/// A tenth of a voxel over the surface: 0.5 % of a fine ball, 5 % of what is hardly resolved.
TEST(ImportComparison, AllowsAVolumeByTheVoxel) {
  EXPECT_EQ(imported_and_compared(ball_mesh(10.0, 4), 0.1).volume_margin, 0.005);
  EXPECT_NEAR(imported_and_compared(ball_mesh(10.0, 4), 0.8).volume_margin, 0.1 * 3.0 * 0.08, 1e-3);
  EXPECT_EQ(imported_and_compared(ball_mesh(2.0, 4), 0.5).volume_margin, 0.05);
}

}  // namespace
}  // namespace argil::io
