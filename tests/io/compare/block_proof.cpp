// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/block_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/field_sampler.h"
#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

constexpr double kBallMm = 2.0;
constexpr double kBallVoxelMm = 0.2;

Clay ball() {
  ClayOptions options;
  options.voxel_mm = kBallVoxelMm;
  return Clay::ball(kBallMm, options).value();
}

TriangleMesh scaled(TriangleMesh mesh, double by) {
  for (Vec3& p : mesh.positions) p *= by;
  return mesh;
}

/// The nearest of all triangles.
class NearestTriangle final : public mesh::NearTriangles {
 public:
  explicit NearestTriangle(const TriangleMesh& mesh) : distance_(mesh.positions, mesh.triangles) {}
  double distance_mm(const Vec3& p, double /*enough_mm*/) override {
    return distance_.closest(p, std::numeric_limits<double>::infinity()).distance;
  }
  double distance_far_mm(const Vec3& p, double enough_mm) override {
    return distance_mm(p, enough_mm);
  }

 private:
  MeshDistance distance_;
};

struct Share {
  double cells = 0.0;
  double triangles = 0.0;
};

/// What part of the ball's field and of its surface, made larger by `more_mm`, is proven.
Share proven(double more_mm, double bound_mm) {
  const Clay clay = ball();
  const TriangleMesh surface = extract_surface(clay);
  const TriangleMesh mesh = scaled(surface, 1.0 + more_mm / kBallMm);
  const Progress nobody;
  const TriangleMesh nothing;
  const BlockProof proof(surface, clay, nothing, bound_mm, Pace(nobody, "proof"));
  EXPECT_GT(proof.cells(), surface.triangles.size() / 4);
  NearestTriangle near(mesh);
  Share share;
  for (std::uint32_t c = 0; c < proof.cells(); ++c) share.cells += proof.is_near(c, near) ? 1 : 0;
  std::vector<mesh::Corners> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    corners.push_back(mesh::corners_of(mesh, t));
  }
  std::vector<std::uint8_t> is_near(corners.size());
  proof.ask_triangles(corners, is_near);
  for (const std::uint8_t yes : is_near) share.triangles += yes;
  return {share.cells / proof.cells(), share.triangles / static_cast<double>(corners.size())};
}

TEST(BlockProof, ProvesWhatIsWithinTheBound) {
  const Share share = proven(0.07, 0.1);
  EXPECT_EQ(share.cells, 1.0);
  EXPECT_EQ(share.triangles, 1.0);
}

TEST(BlockProof, ProvesNothingThatIsBeyondTheBound) {
  for (const double more : {-0.11, 0.11}) {
    const Share share = proven(more, 0.1);
    EXPECT_EQ(share.cells, 0.0);
    EXPECT_EQ(share.triangles, 0.0);
  }
}

using CellPlace = std::array<long, 3>;

/// Where proofs ask first, in half voxels: the middle of the cell.
class FirstPlace final : public mesh::NearTriangles {
 public:
  double distance_mm(const Vec3& p, double /*enough_mm*/) override {
    const auto of = [](double x) { return std::lround(2.0 * x / kBallVoxelMm); };
    if (!at) at = {of(p.x), of(p.y), of(p.z)};
    return 0.0;
  }
  double distance_far_mm(const Vec3& p, double enough_mm) override {
    return distance_mm(p, enough_mm);
  }
  std::optional<CellPlace> at;
};

/// The middles of all cells of level 0 of which some corners are inside and some outside.
std::set<CellPlace> crossed_cells(const Clay& clay, int reach) {
  std::set<CellPlace> crossed;
  FieldSampler field(clay);
  for (int i = -reach; i < reach; ++i) {
    for (int j = -reach; j < reach; ++j) {
      for (int k = -reach; k < reach; ++k) {
        const FieldCell cell = field.cell_at(kBallVoxelMm * Vec3{i + 0.5, j + 0.5, k + 0.5});
        const auto inside = std::count_if(cell.corners.begin(), cell.corners.end(),
                                          [](float v) { return v < 0.0F; });
        const bool is_finest = cell.per_mm > 0.0 && cell.level == 0;
        if (is_finest && inside != 0 && inside != 8) {
          crossed.insert({2 * i + 1, 2 * j + 1, 2 * k + 1});
        }
      }
    }
  }
  return crossed;
}

TEST(BlockProof, AsksForEveryCellThatTheFieldsSurfacePassesThrough) {
  // Faces in lattice planes, where triangles lie a little outside of their cells; and round ones.
  ClayOptions options;
  options.voxel_mm = kBallVoxelMm;
  const Clay block = Clay::block({4.0, 4.0, 3.6}, options).value();
  const Clay round = ball();
  for (const Clay* const clay : {&block, &round}) {
    const TriangleMesh surface = extract_surface(*clay);
    const Progress nobody;
    const TriangleMesh nothing;
    const BlockProof proof(surface, *clay, nothing, 1.0, Pace(nobody, "proof"));
    std::set<CellPlace> asked;
    for (std::uint32_t c = 0; c < proof.cells(); ++c) {
      FirstPlace first;
      proof.is_near(c, first);
      if (first.at) asked.insert(*first.at);
    }
    const std::set<CellPlace> crossed = crossed_cells(*clay, 14);
    EXPECT_GT(crossed.size(), 500U);
    EXPECT_TRUE(std::includes(asked.begin(), asked.end(), crossed.begin(), crossed.end()));
  }
}

}  // namespace
}  // namespace argil::io
