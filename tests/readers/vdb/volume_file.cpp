// SPDX-License-Identifier: GPL-3.0-or-later
// The field as one grid: OpenVDB's own checks, values against the clay, and what cannot be written.
#include "argil/io/volume_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetMeasure.h>

#include "argil/engine/surface.h"
#include "argil/io/project_file.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::ScratchFolder;
using testing::HasSubstr;

/// A ball with a fine groove, so that several levels have a part of the surface.
Clay grooved_ball(double radius_mm = test::effort(4.0, 8.0)) {
  Clay clay = Clay::ball(radius_mm, ClayOptions{.voxel_mm = 0.1}).value();
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {0.8, 0.8, 0.8};
  stroke.samples = {{0.0, {-2.0, 0.0, radius_mm}, {}, 1.0}, {1.0, {2.0, 0.0, radius_mm}, {}, 1.0}};
  EXPECT_TRUE(clay.apply(stroke));
  EXPECT_GT(clay.level_count(), 2);
  return clay;
}

Clay thin_sheets() {
  Box3 box;
  box.include(Vec3{-6, -6, -6});
  box.include(Vec3{6, 6, 6});
  const auto distance = [](const Vec3& p) {
    const double layer = std::abs(std::abs(p.x) - 2.0) - 0.35;
    return std::max({layer, std::abs(p.y) - 4.0, std::abs(p.z) - 4.0});
  };
  return Clay::from_distance(distance, box, ClayOptions{.voxel_mm = 0.25}).value();
}

VdbGrid::Ptr read_grid(const std::filesystem::path& path) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open();
  EXPECT_EQ(file.getGrids()->size(), 1U);
  return openvdb::gridPtrCast<VdbGrid>(file.readGrid("surface"));
}

VdbGrid::Ptr written(const Clay& clay) {
  const ScratchFolder folder;
  const auto report = export_volume(folder / "v.vdb", clay);
  EXPECT_TRUE(report) << report.error().message;
  VdbGrid::Ptr grid = read_grid(folder / "v.vdb");
  EXPECT_EQ(report.value().active_voxels, static_cast<std::int64_t>(grid->activeVoxelCount()));
  EXPECT_EQ(report.value().leaves, static_cast<std::int64_t>(grid->tree().leafCount()));
  EXPECT_EQ(report.value().voxel_mm, clay.options().voxel_mm);
  return grid;
}

TEST(VolumeFile, PassesEveryCheckOfOpenVdb) {
  const VdbGrid::Ptr ball =
      written(Clay::ball(test::effort(4.0, 8.0), ClayOptions{.voxel_mm = 0.1}).value());
  EXPECT_EQ(openvdb::tools::checkLevelSet(*ball), "");
  // Number 9 asks for a slope near 1 everywhere, which no narrow band has between two surfaces.
  constexpr std::size_t kAllButSlope = 8;
  EXPECT_EQ(openvdb::tools::checkLevelSet(*written(grooved_ball()), kAllButSlope), "");
  EXPECT_EQ(openvdb::tools::checkLevelSet(*written(thin_sheets()), kAllButSlope), "");
}

TEST(VolumeFile, SaysWhatItIs) {
  const Clay clay = grooved_ball();
  const VdbGrid::Ptr grid = written(clay);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_NEAR(grid->voxelSize().x(), 0.1, 1e-12);
  EXPECT_EQ(grid->metaValue<std::string>("argil_units"), "mm");
  EXPECT_EQ(grid->getCreator(), "Argil");
}

TEST(VolumeFile, HoldsTheFieldOfTheClay) {
  const Clay clay = grooved_ball();
  const VdbGrid::Ptr grid = written(clay);
  const LevelStack& levels = levels_of(clay);
  std::int64_t stored = 0;
  std::int64_t interpolated = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Coord node = value.getCoord();
    if (const VdbLeaf* leaf = levels.leaf(0, node)) {
      ASSERT_EQ(*value, leaf->buffer().data()[leaf_offset(node)]) << node;
      ++stored;
    } else {
      ASSERT_NEAR(double{*value}, clay.distance_at(node_mm(node, 0.1)), 1e-6) << node;
      ++interpolated;
    }
  }
  EXPECT_GT(stored, 1000);
  EXPECT_GT(interpolated, 1000);
}

/// Three voxels to each side: nothing in the band is missing.
TEST(VolumeFile, IsWholeInItsBand) {
  for (const Clay& clay : {grooved_ball(), thin_sheets()}) {
    const double voxel = clay.options().voxel_mm;
    const VdbGrid::Ptr grid = written(clay);
    const LevelStack& levels = levels_of(clay);
    const auto value = grid->getConstAccessor();
    const Box3 box = clay.bounds_mm();
    std::int64_t seen = 0;
    for (double x = box.min.x - 1.0; x < box.max.x + 1.0; x += 0.37) {
      for (double y = box.min.y - 1.0; y < box.max.y + 1.0; y += 0.31) {
        for (double z = box.min.z - 1.0; z < box.max.z + 1.0; z += 0.29) {
          const Coord node = Coord::round(openvdb::Vec3d(x, y, z) / voxel);
          // A stored node counts: where its level ends, the coarser one beside it may say otherwise
          // by its tolerance, and rounding decides which of both is asked.
          const VdbLeaf* leaf = levels.leaf(0, node);
          const double distance = leaf != nullptr ? double{leaf->buffer().data()[leaf_offset(node)]}
                                                  : clay.distance_at(node_mm(node, voxel));
          ASSERT_NEAR(double{value.getValue(node)}, std::clamp(distance, -3.0 * voxel, 3.0 * voxel),
                      1e-6)
              << node;
          seen += value.isValueOn(node) ? 1 : 0;
        }
      }
    }
    EXPECT_GT(seen, 1000);
  }
}

TEST(VolumeFile, EnclosesTheVolumeOfTheSurface) {
  const Clay clay = grooved_ball(8.0);  // large enough for the bound
  const double volume = openvdb::tools::levelSetVolume(*written(clay));
  EXPECT_NEAR(volume, signed_volume(extract_surface(clay)), 2e-3 * volume);
}

TEST(VolumeFile, RefusesWhatWouldNotFit) {
  const ScratchFolder folder;
  Clay clay = Clay::ball(20.0, ClayOptions{.voxel_mm = 0.05}).value();
  ClayLimits limits;
  limits.memory_bytes = clay.use().level_bytes + (std::int64_t{20} << 20);
  ASSERT_TRUE(clay.set_limits(limits));
  const auto report = export_volume(folder / "v.vdb", clay);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::memory);
  EXPECT_THAT(report.error().message, HasSubstr("--voxel-mm"));
  EXPECT_FALSE(std::filesystem::exists(folder / "v.vdb"));
}

TEST(VolumeFile, LeavesTheOldFileWhenInterrupted) {
  const ScratchFolder folder;
  test::fill(folder / "v.vdb", "old");
  const auto report = export_volume(folder / "v.vdb", thin_sheets(),
                                    [](std::string_view, double) { return false; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(test::content_of(folder / "v.vdb"), "old");
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(VolumeFile, IsNotTakenForAProject) {
  const ScratchFolder folder;
  ASSERT_TRUE(export_volume(folder / "v.vdb", thin_sheets()));
  const auto loaded = load_project(folder / "v.vdb");
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr("not a project"));
}

}  // namespace
}  // namespace argil::io
