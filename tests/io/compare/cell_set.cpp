// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/cell_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/core/progress.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/surface.h"

namespace argil::io {
namespace {

constexpr double kBorderVoxelMm = 0.2;

Clay with_level_borders() {
  // Coarse where it is flat, with faces in lattice planes of levels 0 to 3, where triangles lie a
  // little outside of their cells; and a wavy ball on top.
  const auto distance = [](const Vec3& p) {
    const double slab = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 4.8;
    const double ball = length(p - Vec3{0.3, 0.4, 4.8}) - 1.5 -
                        0.1 * std::sin(6.0 * p.x) * std::sin(6.0 * p.y) * std::sin(6.0 * p.z);
    return std::min(slab, ball);
  };
  ClayOptions options;
  options.voxel_mm = kBorderVoxelMm;
  return Clay::from_distance(distance, {{-8, -8, -8}, {8, 8, 8}}, options).value();
}

/// A level and a place in cells of it.
using BorderCell = std::array<std::int32_t, 4>;

/// All cells of which some corners are inside and some outside, of whatever level is there.
std::set<BorderCell> crossed_of_all_levels(const Clay& clay, int reach) {
  std::set<BorderCell> crossed;
  FieldSampler field(clay);
  for (int i = -reach; i < reach; ++i) {
    for (int j = -reach; j < reach; ++j) {
      for (int k = -reach; k < reach; ++k) {
        const FieldCell cell = field.cell_at(kBorderVoxelMm * Vec3{i + 0.5, j + 0.5, k + 0.5});
        const auto inside = std::count_if(cell.corners.begin(), cell.corners.end(),
                                          [](float v) { return v < 0.0F; });
        if (cell.per_mm == 0.0 || inside == 0 || inside == 8) continue;
        crossed.insert({cell.level, i >> cell.level, j >> cell.level, k >> cell.level});
      }
    }
  }
  return crossed;
}

std::vector<SurfaceCell> cells_of(const Clay& clay, const TriangleMesh& surface) {
  const Progress nobody;
  return surface_cells(surface, clay, Pace(nobody, "cells"));
}

void expect_all_crossed_once(const Clay& clay) {
  const std::vector<SurfaceCell> cells = cells_of(clay, extract_surface(clay));
  std::set<BorderCell> found;
  for (const SurfaceCell& cell : cells) {
    found.insert({cell.level, cell.low[0], cell.low[1], cell.low[2]});
  }
  EXPECT_EQ(found.size(), cells.size());
  const std::set<BorderCell> crossed = crossed_of_all_levels(clay, 40);
  const auto of_level = [&](int level) {
    return std::count_if(crossed.begin(), crossed.end(),
                         [&](const BorderCell& name) { return name[0] == level; });
  };
  EXPECT_GT(of_level(0), 500);
  EXPECT_GT(of_level(1) + of_level(2) + of_level(3), 500);
  EXPECT_EQ(found, crossed);
}

TEST(SurfaceCells, AreThoseThatPhiPassesThroughAtAllLevelsEachOnce) {
  expect_all_crossed_once(with_level_borders());
}

TEST(SurfaceCells, AreThoseOfABlocksFacesAtAllLevels) {
  ClayOptions options;
  options.voxel_mm = kBorderVoxelMm;
  expect_all_crossed_once(Clay::block({12.8, 9.6, 9.2}, options).value());
}

TEST(SurfaceCells, AreTheSameForAnyNumberOfThreads) {
  const Clay clay = with_level_borders();
  const TriangleMesh surface = extract_surface(clay);
  const std::vector<SurfaceCell> several = cells_of(clay, surface);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control some(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<SurfaceCell> again = cells_of(clay, surface);
    ASSERT_EQ(again.size(), several.size());
    for (std::size_t c = 0; c < again.size(); ++c) {
      EXPECT_EQ(again[c].corners, several[c].corners);
      EXPECT_EQ(again[c].low, several[c].low);
      EXPECT_EQ(again[c].first, several[c].first);
      EXPECT_EQ(again[c].count, several[c].count);
    }
  }
}

TEST(SurfaceCells, HearAnInterruptionWhileBlocksAreJoined) {
  const Clay clay = with_level_borders();
  const TriangleMesh surface = extract_surface(clay);
  // Joining is told from 0.7 to 0.8.
  const Progress stop = [](std::string_view, double fraction) {
    return fraction <= 0.71 || fraction >= 0.79;
  };
  EXPECT_THROW(surface_cells(surface, clay, Pace(stop, "cells")), Interrupted);
}

}  // namespace
}  // namespace argil::io
