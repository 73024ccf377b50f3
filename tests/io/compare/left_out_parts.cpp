// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/left_out_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/export.h"
#include "argil/mesh/small_components.h"

#include "compare/block_proof.h"
#include "compare/surface_near.h"
#include "io/compare/nearest_triangle.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

constexpr double kSpeckVoxelMm = 0.2;

/// How far the clay reaches, in voxels: enough for phi to hold cut and speck apart in their cell,
/// or so much that phi = 0 joins them in it, though the extracted surface does not.
struct SpeckSizes {
  double cut = 0.25;
  double radius = 0.5;
};
constexpr SpeckSizes kJoined{0.45, 0.75};

/// A cube with a corner cut off askew, and near the middle of the cut a speck, so that the cell
/// from the origin on has a corner in each of them: (0, 0, 0) and (1, 1, 1).
struct SpeckAboveCut {
  explicit SpeckAboveCut(const SpeckSizes& sizes = {}) {
    const auto distance = [&](const Vec3& p) {
      const Vec3 in = p / kSpeckVoxelMm;
      const double cut = (in.x + in.y + in.z) / std::sqrt(3.0) - sizes.cut;
      const double cube = std::max({std::abs(in.x), std::abs(in.y), std::abs(in.z)}) - 11.7;
      const double speck = length(in - Vec3{1, 1, 1}) - sizes.radius;
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

TEST(LeftOutParts, GoByTheEdgeOfAVertexAndNotByWhatIsNear) {
  const SpeckAboveCut scene;
  // Where the cut passes through edges of the cell its vertices have been moved aside, and vertices
  // of a speck are next to those places, but not on the edges.
  TriangleMesh moved = scene.surface;
  TriangleMesh beside = scene.left_out;
  int places = 0;
  for (Vec3& p : moved.positions) {
    const Vec3 in = p / kSpeckVoxelMm;
    const bool is_on_cut = std::min({in.x, in.y, in.z}) > -1e-9 && in.x + in.y + in.z < 0.999;
    if (!is_on_cut) continue;
    ++places;
    beside.positions.push_back(p + kSpeckVoxelMm * Vec3{0.01, 0.01, 0.01});
    p += 0.1 * kSpeckVoxelMm * Vec3{1, 1, 1};
  }
  ASSERT_EQ(places, 3);
  const LeftOutParts parts(moved, beside, scene.cells, kSpeckVoxelMm, scene.pace);
  EXPECT_FALSE(parts.has_all(scene.both, {0.0, 0.0, 0.0}, 0.5));
  EXPECT_TRUE(parts.has_all(scene.both, {0.5, 0.5, 0.5}, 0.5));
}

TEST(LeftOutParts, KeepAnEdgeOfWhichFinerCellsKeepAPart) {
  // An edge of a cell of the next coarser level, in whose lattice it runs from 0 to 1 along x.
  const auto on_edge = [](double x) {
    return TriangleMesh{{{x * kSpeckVoxelMm, 0.0, 0.0}}, {}, {}};
  };
  SurfaceCell cell;
  cell.level = 1;
  cell.corners.fill(1.0F);
  cell.corners[0] = -1.0F;
  TriangleMesh others = on_edge(0.6);
  for (const Vec3& way : {Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    others.positions.push_back(1.2 * kSpeckVoxelMm * way);
  }
  const Progress nobody;
  const Pace pace(nobody, "");
  const auto is_left_out = [&](const TriangleMesh& kept) {
    return LeftOutParts(kept, others, {cell}, kSpeckVoxelMm, pace).has_all(0, {}, 1.0);
  };
  EXPECT_TRUE(is_left_out({}));
  EXPECT_TRUE(is_left_out(on_edge(2.5)));
  EXPECT_FALSE(is_left_out(on_edge(1.3)));
}

TEST(LeftOutParts, KeepAnEdgeThatAnEvenNumberOfLeftOutVerticesLieOn) {
  // An edge of a cell two levels coarser, in whose lattice it runs from 0 to 4 voxels along x, with
  // different signs at its ends: finer cells cut it in four, a speck has two of the parts, and what
  // is kept one, whose vertex was moved off it.
  SurfaceCell cell;
  cell.level = 2;
  cell.corners.fill(1.0F);
  cell.corners[0] = -1.0F;
  TriangleMesh others;
  for (const Vec3& p : {Vec3{0.6, 0, 0}, Vec3{0, 1.2, 0}, Vec3{0, 0, 1.2}}) {
    others.positions.push_back(kSpeckVoxelMm * p);
  }
  const TriangleMesh aside{{kSpeckVoxelMm * Vec3{2.5, 0.1, 0.1}}, {}, {}};
  const Progress nobody;
  const auto parts = [&] {
    return LeftOutParts(aside, others, {cell}, kSpeckVoxelMm, Pace(nobody, ""));
  };
  EXPECT_TRUE(parts().has_all(0, {}, 1.0));
  EXPECT_TRUE(parts().ambiguous().empty());
  others.positions.push_back(kSpeckVoxelMm * Vec3{1.7, 0, 0});
  EXPECT_FALSE(parts().has_all(0, {}, 1.0));
  EXPECT_THAT(parts().ambiguous(), testing::Contains(0U));
  others.positions.push_back(kSpeckVoxelMm * Vec3{3.2, 0, 0});
  EXPECT_TRUE(parts().has_all(0, {}, 1.0));
}

TEST(LeftOutParts, AreAmbiguousByWhatIsNearAlone) {
  for (const SpeckSizes& sizes : {SpeckSizes{}, kJoined}) {
    const SpeckAboveCut scene(sizes);
    const TriangleMesh near = surface_near(scene.surface, scene.left_out, *scene.clay, scene.pace);
    EXPECT_GT(near.triangles.size(), 0U);
    EXPECT_LT(near.triangles.size(), scene.surface.triangles.size());
    const auto cells = surface_cells(near, *scene.clay, scene.pace);
    const LeftOutParts some(near, scene.left_out, cells, kSpeckVoxelMm, scene.pace);
    const LeftOutParts all(scene.surface, scene.left_out, scene.cells, kSpeckVoxelMm, scene.pace);
    EXPECT_EQ(some.ambiguous(), all.ambiguous());
  }
}

TEST(LeftOutParts, NameWhatTheFieldDoesNotTellApart) {
  const SpeckAboveCut apart;
  const SpeckAboveCut joined(kJoined);
  const auto ambiguous = [](const SpeckAboveCut& scene) {
    return LeftOutParts(scene.surface, scene.left_out, scene.cells, kSpeckVoxelMm, scene.pace)
        .ambiguous();
  };
  EXPECT_TRUE(ambiguous(apart).empty());
  ASSERT_EQ(joined.left_out.triangles.size(), 8U);
  // On the three edges of the cell that end in the speck.
  EXPECT_EQ(ambiguous(joined).size(), 3U);
  const LeftOutParts parts(joined.surface, joined.left_out, joined.cells, kSpeckVoxelMm,
                           joined.pace);
  EXPECT_FALSE(parts.has_all(joined.both, {0.5, 0.5, 0.5}, 0.5));
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

TEST(ExportMesh, WithABoundKeepsASpeckThatTheClayDoesNotTellFromWhatIsBeside) {
  const test::ScratchFolder folder;
  ExportOptions options;
  options.max_error_mm = 0.6 * kSpeckVoxelMm;
  const auto exported = [&](const SpeckAboveCut& scene, const ExportOptions& as) {
    Result<ExportReport> report = export_mesh(folder / "a.3mf", *scene.clay, as);
    EXPECT_TRUE(report) << report.error().message;
    return report ? std::move(report).value() : ExportReport{};
  };
  const ExportReport apart = exported(SpeckAboveCut(), options);
  EXPECT_EQ(apart.removed_components, 1);
  EXPECT_EQ(apart.verdict.components, 1);
  EXPECT_EQ(apart.certificate.proven_max_mm, options.max_error_mm);
  const SpeckAboveCut joined(kJoined);
  const ExportReport kept = exported(joined, options);
  EXPECT_EQ(kept.removed_components, 0);
  EXPECT_EQ(kept.verdict.components, 2);
  EXPECT_EQ(kept.certificate.proven_max_mm, options.max_error_mm);
  EXPECT_LE(kept.max_error_mm, options.max_error_mm);
  EXPECT_LT(kept.triangles, kept.certificate.surface_triangles / 4);
  // Where nothing is to be proven it is left out.
  const ExportReport whole = exported(joined, {});
  EXPECT_EQ(whole.removed_components, 1);
  EXPECT_EQ(whole.verdict.components, 1);
}

TEST(DecimateInput, NamesWhatWasLeftOutAndIsNotToldApartBeforeTheWork) {
  const SpeckAboveCut scene(kJoined);
  mesh::DecimateOptions options;
  options.max_error_mm = 0.6 * kSpeckVoxelMm;
  double most = 0.0;
  const auto listen = [&](std::string_view, double fraction) {
    most = std::max(most, fraction);
    return true;
  };
  const auto made = decimate(scene.surface, *scene.clay, options, scene.left_out, listen);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(made.error().message, testing::HasSubstr("the component at (0."));
  EXPECT_THAT(made.error().message, testing::HasSubstr("leave it in the surface"));
  EXPECT_LE(most, 0.1);
}

}  // namespace
}  // namespace argil::io
