// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/left_out_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/mesh/small_components.h"

#include "compare/block_proof.h"
#include "io/compare/nearest_triangle.h"

namespace argil::io {
namespace {

constexpr double kSpeckVoxelMm = 0.2;

/// A cube with a corner cut off askew, and near the middle of the cut a speck, so that the cell
/// from the origin on has a corner in each of them: (0, 0, 0) and (1, 1, 1).
struct SpeckAboveCut {
  SpeckAboveCut() {
    const auto distance = [](const Vec3& p) {
      const Vec3 in = p / kSpeckVoxelMm;
      const double cut = (in.x + in.y + in.z) / std::sqrt(3.0) - 0.25;
      const double cube = std::max({std::abs(in.x), std::abs(in.y), std::abs(in.z)}) - 12.0;
      const double speck = length(in - Vec3{1, 1, 1}) - 0.5;
      return kSpeckVoxelMm * std::min(std::max(cut, cube), speck);
    };
    ClayOptions options;
    options.voxel_mm = kSpeckVoxelMm;
    const Vec3 corner{3.6, 3.6, 3.6};
    clay.emplace(Clay::from_distance(distance, {-corner, corner}, options).value());
    surface = extract_surface(*clay);
    surface.normals = {};
    left_out = mesh::drop_small_components(surface, kSpeckVoxelMm).mesh;
    cells = surface_cells(surface, *clay, pace);
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
      if (cells[c].level == 0 && cells[c].low == std::array<std::int32_t, 3>{}) both = c;
    }
  }
  /// Whether that cell is near a mesh, where so much was left out.
  bool is_near(double bound_mm, const TriangleMesh& without, mesh::NearTriangles& mesh) const {
    ExtractedSurface extracted(surface, *clay, without);
    return BlockProof(extracted, bound_mm, pace).is_near(both, mesh);
  }

  Progress nobody;
  Pace pace{nobody, ""};
  std::optional<Clay> clay;
  TriangleMesh surface;
  TriangleMesh left_out;
  std::vector<SurfaceCell> cells;
  std::uint32_t both = 0;  ///< the cell with a corner in each
};

TEST(LeftOutParts, TellsASpeckFromWhatIsKeptInTheSameCell) {
  const SpeckAboveCut scene;
  ASSERT_EQ(scene.left_out.triangles.size(), 8U);
  ASSERT_LT(scene.cells[scene.both].corners[0], 0.0F);
  ASSERT_LT(scene.cells[scene.both].corners[7], 0.0F);
  const LeftOutParts parts(scene.surface, scene.left_out, scene.cells, kSpeckVoxelMm, scene.pace);
  EXPECT_TRUE(parts.has_all(scene.both, {0.5, 0.5, 0.5}, 0.5));
  EXPECT_TRUE(parts.has_all(scene.both, {0.5, 1.0, 1.0}, 0.0));
  EXPECT_FALSE(parts.has_all(scene.both, {0.0, 0.0, 0.0}, 0.5));
  EXPECT_FALSE(parts.has_all(scene.both, {0.0, 0.0, 0.0}, 1.0));
  // Nothing of phi = 0 is there.
  EXPECT_FALSE(parts.has_all(scene.both, {0.5, 0.0, 0.0}, 0.25));
}

TEST(LeftOutParts, TellsItAmongManySpecksInOnePlane) {
  const SpeckAboveCut scene;
  // Specks far away, all of them as far along x as the one in the cell.
  TriangleMesh many = scene.left_out;
  for (int n = 0; n < 100'000; ++n) {
    many.positions.push_back({kSpeckVoxelMm, 100.0 + 0.1 * (n % 317), 200.0 + 0.1 * (n / 317)});
  }
  const LeftOutParts one(scene.surface, scene.left_out, scene.cells, kSpeckVoxelMm, scene.pace);
  const LeftOutParts all(scene.surface, many, scene.cells, kSpeckVoxelMm, scene.pace);
  for (std::uint32_t c = 0; c < scene.cells.size(); ++c) {
    for (int n = 0; n < 8; ++n) {
      const Vec3 low{0.5 * (n & 1), 0.5 * (n >> 1 & 1), 0.5 * (n >> 2)};
      ASSERT_EQ(one.has_all(c, low, 0.5), all.has_all(c, low, 0.5)) << c << ", " << n;
    }
  }
  EXPECT_TRUE(all.has_all(scene.both, {0.5, 0.5, 0.5}, 0.5));
}

TEST(LeftOutParts, ExcuseASpeckAndNothingElseOfItsCell) {
  const SpeckAboveCut scene;
  NearestTriangle as_extracted(scene.surface);
  const double bound = 0.25 * kSpeckVoxelMm;
  EXPECT_TRUE(scene.is_near(bound, scene.left_out, as_extracted));
  EXPECT_FALSE(scene.is_near(bound, {}, as_extracted));
  // The cut is 0.6 voxel off, beyond the bound. The middle of the cell is nearer to the speck.
  TriangleMesh lower = scene.surface;
  for (Vec3& p : lower.positions) p -= 0.6 * kSpeckVoxelMm / std::sqrt(3.0) * Vec3{1, 1, 1};
  NearestTriangle off(lower);
  EXPECT_FALSE(scene.is_near(bound, scene.left_out, off));
}

}  // namespace
}  // namespace argil::io
