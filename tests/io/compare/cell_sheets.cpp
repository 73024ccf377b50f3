// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/cell_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/measure_error.h"
#include "argil/mesh/check.h"

#include "compare/lattice_edge.h"

namespace argil::io {
namespace {

constexpr double kShellVoxelMm = 0.2;
constexpr double kShellRadiusMm = 3.03;

/// A hollow ball whose wall is so many voxels thick. Up to 1.73 voxels both of its sheets pass
/// through cells; below 1.42 it has holes.
struct Shell {
  explicit Shell(double thick_voxels) : clay(made(thick_voxels)), surface(extract_surface(clay)) {
    surface.normals = {};
    cells = surface_cells(surface, clay, pace);
  }
  static Clay made(double thick_voxels) {
    const auto distance = [=](const Vec3& p) {
      return std::abs(length(p) - kShellRadiusMm) - 0.5 * thick_voxels * kShellVoxelMm;
    };
    ClayOptions options;
    options.voxel_mm = kShellVoxelMm;
    return Clay::from_distance(distance, {{-4, -4, -4}, {4, 4, 4}}, options).value();
  }
  static bool is_outer(const Vec3& p) { return length(p) > kShellRadiusMm; }

  Progress nobody;
  Pace pace{nobody, ""};
  Clay clay;
  TriangleMesh surface;
  std::vector<SurfaceCell> cells;
};

TEST(CellSheets, AreFoundWhereBothPassThroughACell) {
  const Shell shell(1.5);
  const CellSheets sheets(shell.surface, shell.cells, kShellVoxelMm, shell.pace);
  int both = 0;
  int needless = 0;
  for (std::uint32_t c = 0; c < shell.cells.size(); ++c) {
    const SurfaceCell& cell = shell.cells[c];
    bool has[2] = {false, false};
    for_each_cut_edge(cell, [&](const LatticeEdge&, const Vec3& place) {
      const Vec3 at = cell.low_mm(kShellVoxelMm) + cell.side_mm(kShellVoxelMm) * place;
      has[Shell::is_outer(at) ? 1 : 0] = true;
    });
    const bool own =
        Shell::is_outer(shell.surface.positions[shell.surface.triangles[cell.first][0]]);
    const auto others = sheets.others_in(c);
    if (!has[own ? 0 : 1]) {
      needless += others.empty() ? 0 : 1;
      continue;
    }
    ++both;
    EXPECT_TRUE(std::any_of(others.begin(), others.end(), [&](std::uint32_t v) {
      return Shell::is_outer(shell.surface.positions[v]) != own;
    })) << c;
  }
  EXPECT_GT(both, 100);
  EXPECT_LT(needless, static_cast<int>(shell.cells.size() / 50));
}

TEST(CellSheets, AreNoneOfASolidBall) {
  const Shell shell(8.0);
  const CellSheets sheets(shell.surface, shell.cells, kShellVoxelMm, shell.pace);
  for (std::uint32_t c = 0; c < shell.cells.size(); ++c) EXPECT_TRUE(sheets.others_in(c).empty());
}

TEST(DecimateThinWalls, AreProvenOnBothSides) {
  for (const double thick : {1.3, 1.5}) {
    SCOPED_TRACE(thick);
    const Shell shell(thick);
    mesh::DecimateOptions options;
    options.max_error_mm = 0.6 * kShellVoxelMm;
    const auto made = decimate(shell.surface, shell.clay, options);
    ASSERT_TRUE(made) << made.error().message;
    const TriangleMesh& mesh = made.value().mesh;
    EXPECT_LT(mesh.triangles.size(), shell.surface.triangles.size() / 4);
    EXPECT_TRUE(mesh::check_mesh(mesh).printable);
    const auto error = measure_error(mesh, shell.surface, shell.clay);
    ASSERT_TRUE(error);
    EXPECT_LE(error.value().max_mm(), options.max_error_mm);
  }
}

TEST(DecimateThinWallsGolden, AreTheSameForAnyNumberOfThreads) {
  const Shell shell(1.5);
  mesh::DecimateOptions options;
  options.max_error_mm = 0.6 * kShellVoxelMm;
  std::vector<Vec3> one;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto made = decimate(shell.surface, shell.clay, options);
    ASSERT_TRUE(made) << made.error().message;
    if (one.empty()) one = made.value().mesh.positions;
    EXPECT_EQ(made.value().mesh.positions, one);
  }
}

}  // namespace
}  // namespace argil::io
