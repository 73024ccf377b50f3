// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/block_proof.h"

#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace argil::io
