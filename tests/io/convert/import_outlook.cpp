// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/import_outlook.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/prepared_mesh.h"

#include "support/effort.h"
#include "support/models.h"
#include "support/shapes.h"

namespace argil {
namespace {

/// What was foretold and what came, as their quotient.
struct Quotients {
  double vertices = 0.0;
  double bytes = 0.0;
};

Quotients told_over_made(const TriangleMesh& mesh, int voxels) {
  const Vec3 size = bounds(mesh).size();
  const double side = std::max({size.x, size.y, size.z});
  ClayOptions options;
  options.voxel_mm = side / voxels;
  const auto made = import_mesh(mesh, options);
  EXPECT_TRUE(made.ok());
  const Clay& clay = made.value().clay;
  double bytes = 0.0;
  for (const LevelStats& level : clay.level_stats()) bytes += static_cast<double>(level.bytes);
  const io::ImportOutlook::Cost told = io::ImportOutlook(mesh).at(voxels);
  return {told.vertices / static_cast<double>(extract_surface(clay).positions.size()),
          told.bytes / bytes};
}

class ImportOutlook : public testing::TestWithParam<const char*> {};

TEST_P(ImportOutlook, IsWithinAQuarterOfWhatImportMakes) {
  ARGIL_MODEL_OR_SKIP(file, GetParam());
  io::MeshPreparation wanted;
  wanted.size_mm = 80.0;
  const auto prepared = io::read_prepared_mesh(file, wanted);
  ASSERT_TRUE(prepared.ok());
  for (const int voxels : test::effort(std::vector{128, 256}, std::vector{128, 256, 400, 700})) {
    const Quotients off = told_over_made(prepared.value().mesh, voxels);
    EXPECT_NEAR(off.vertices, 1.0, 0.25) << voxels;
    EXPECT_NEAR(off.bytes, 1.0, 0.25) << voxels;
    RecordProperty("vertices_" + std::to_string(voxels), std::to_string(off.vertices));
    RecordProperty("bytes_" + std::to_string(voxels), std::to_string(off.bytes));
  }
}

INSTANTIATE_TEST_SUITE_P(Models, ImportOutlook,
                         testing::Values("stanford-bunny.obj", "cow.obj", "rocker-arm.obj",
                                         "fandisk.obj", "spot.obj", "teapot.obj"),
                         [](const auto& named) { return test::name_of_model(named.param); });

TEST(ImportOutlookOf, DoesNotDependOnTheUnit) {
  TriangleMesh mesh = test::ball_mesh(20.0, 4);
  const io::ImportOutlook::Cost small = io::ImportOutlook(mesh).at(200.0);
  for (Vec3& p : mesh.positions) p *= 1024.0;
  const io::ImportOutlook::Cost large = io::ImportOutlook(mesh).at(200.0);
  EXPECT_DOUBLE_EQ(small.vertices, large.vertices);
  EXPECT_DOUBLE_EQ(small.bytes, large.bytes);
}

TEST(ImportOutlookOf, GrowsWithDetailAndIsNothingOfNothing) {
  const io::ImportOutlook outlook(test::ball_mesh(20.0, 4));
  double before = 0.0;
  for (double voxels = 16.0; voxels < 70'000.0; voxels *= 1.7) {
    const double now = outlook.at(voxels).vertices;
    EXPECT_GT(now, before) << voxels;
    before = now;
  }
  EXPECT_EQ(io::ImportOutlook().at(100.0).vertices, 0.0);
  EXPECT_EQ(io::ImportOutlook(TriangleMesh()).at(100.0).bytes, 0.0);
}

}  // namespace
}  // namespace argil
