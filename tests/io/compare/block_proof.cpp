// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/block_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/field_sampler.h"
#include "argil/engine/surface.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/triangle_question.h"
#include "io/compare/nearest_triangle.h"

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
  ExtractedSurface extracted(surface, clay, nothing);
  const BlockProof proof(extracted, bound_mm, Pace(nobody, "proof"));
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
    ExtractedSurface extracted(surface, *clay, nothing);
    const BlockProof proof(extracted, 1.0, Pace(nobody, "proof"));
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

/// Flat sides at coarse levels, and waves at the finest.
Clay waves_on_a_cube() {
  const auto distance = [](const Vec3& p) {
    const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 5.03;
    const double waves = length(p - Vec3{0.3, 0.4, 5.0}) - 1.5 -
                         0.1 * std::sin(6.0 * p.x) * std::sin(6.0 * p.y) * std::sin(6.0 * p.z);
    return std::min(cube, waves);
  };
  ClayOptions options;
  options.voxel_mm = kBallVoxelMm;
  return Clay::from_distance(distance, {{-8, -8, -8}, {8, 8, 8}}, options).value();
}

/// A triangle and the greatest |phi| that points of it have.
struct AskewTriangle {
  mesh::Corners corners;
  double greatest_mm = 0.0;
};

/// Triangles of some two voxels, any way turned, with corners in cells of several levels.
std::vector<AskewTriangle> across_levels(const Clay& clay, std::size_t count) {
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  FieldSampler field(clay);
  std::vector<AskewTriangle> found;
  while (found.size() < count) {
    const Vec3 at{3.0 * number(), 3.0 * number(), 5.0 + 0.6 * number()};
    AskewTriangle one;
    std::set<int> levels;
    for (Vec3& corner : one.corners) {
      corner = at + kBallVoxelMm * Vec3{number(), number(), number()};
      const FieldCell cell = field.cell_at(corner);
      levels.insert(cell.per_mm > 0.0 ? cell.level : -1);
    }
    if (levels.size() < 2 || levels.count(-1) > 0) continue;
    mesh::for_each_sample(24, [&](const std::array<double, 3>& w) {
      const Vec3 p = w[0] * one.corners[0] + w[1] * one.corners[1] + w[2] * one.corners[2];
      one.greatest_mm = std::max(one.greatest_mm, std::abs(field.distance_mm(p)));
    });
    found.push_back(one);
  }
  return found;
}

TEST(BlockProof, AsksForTrianglesAcrossLevelsAsExactly) {
  const Clay clay = waves_on_a_cube();
  const TriangleMesh surface = extract_surface(clay);
  const TriangleMesh nothing;
  ExtractedSurface extracted(surface, clay, nothing);
  const Progress nobody;
  const auto is_near = [&](const AskewTriangle& triangle, double bound_mm) {
    const BlockProof proof(extracted, bound_mm, Pace(nobody, "proof"));
    std::uint8_t answer = 0;
    proof.ask_triangles({&triangle.corners, 1}, {&answer, 1});
    return answer != 0;
  };
  const std::vector<AskewTriangle> triangles = across_levels(clay, 300);
  std::size_t proven = 0;
  for (const AskewTriangle& triangle : triangles) {
    EXPECT_FALSE(is_near(triangle, 0.99 * triangle.greatest_mm));
    // Between the points looked at it may be more, and phi jumps where levels meet.
    proven += is_near(triangle, 1.1 * triangle.greatest_mm + 0.02 * kBallVoxelMm) ? 1 : 0;
  }
  EXPECT_GT(proven, triangles.size() * 9 / 10);
}

/// Triangles of any shape and of up to some ten voxels, with the greatest |phi| that points of them
/// have.
std::vector<AskewTriangle> of_any_shape(const Clay& clay, std::size_t count) {
  std::mt19937 random(9);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  FieldSampler field(clay);
  std::vector<AskewTriangle> found;
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3 at{1.5 * number(), 1.5 * number(), 6.2 + 0.5 * number()};
    const double size = (n % 2 == 0 ? 1.0 : 5.0) * kBallVoxelMm;
    AskewTriangle one;
    for (Vec3& corner : one.corners) corner = at + size * Vec3{number(), number(), number()};
    const Vec3 along = one.corners[1] - one.corners[0];
    if (n % 4 == 2) one.corners[2] = one.corners[0] + 0.4 * along + Vec3{0.0, 1e-5, 0.0};
    if (n % 8 == 3) one.corners[2] = one.corners[0] + 0.4 * along;
    mesh::for_each_sample(60, [&](const std::array<double, 3>& w) {
      const Vec3 p = w[0] * one.corners[0] + w[1] * one.corners[1] + w[2] * one.corners[2];
      one.greatest_mm = std::max(one.greatest_mm, std::abs(field.distance_mm(p)));
    });
    for (const Vec3& corner : one.corners) {
      one.greatest_mm = std::max(one.greatest_mm, std::abs(field.distance_mm(corner)));
    }
    found.push_back(one);
  }
  return found;
}

TEST(TriangleQuestion, IsExactForTrianglesOfAnyShape) {
  const Clay clay = waves_on_a_cube();
  FieldSampler field(clay);
  const auto is_near = [&](const AskewTriangle& triangle, double bound_mm) {
    return TriangleQuestion(bound_mm, kBallVoxelMm, field).is_near(triangle.corners);
  };
  std::size_t missed = 0;
  const std::vector<AskewTriangle> triangles = of_any_shape(clay, 400);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const AskewTriangle& triangle = triangles[n];
    EXPECT_FALSE(is_near(triangle, 0.999 * triangle.greatest_mm)) << n;
    // What lies in the last boxes that were cut, and between the points looked at.
    missed += is_near(triangle, 1.03 * triangle.greatest_mm + 0.01 * kBallVoxelMm) ? 0 : 1;
  }
  EXPECT_LE(missed, triangles.size() / 50);
}

TEST(TriangleQuestion, CallsNoSliverNearByASideThatLooksTheOtherWay) {
  const Clay clay = Clay::ball(2.0, {0.2, 0.1}).value();
  FieldSampler field(clay);
  for (const double f : {1.2e-8, 1e-9, 1e-10, 3e-8}) {
    for (const double along : {8.0, 1.0, 1e-2, 1e-4, 0.0}) {
      for (const double turn : {f, -f}) {
        // From 1 mm below the surface outward: phi is beyond 0.4 mm along most of it.
        mesh::Corners sliver{Vec3{1.0, 0.0, 0.0}, Vec3{1.0 + along, turn, f}, Vec3{21.0, 0.0, 0.0}};
        EXPECT_FALSE(TriangleQuestion(0.4, 0.2, field).is_near(sliver)) << f << " " << along;
        std::swap(sliver[0], sliver[1]);
        EXPECT_FALSE(TriangleQuestion(0.4, 0.2, field).is_near(sliver)) << f << " " << along;
      }
    }
  }
}

}  // namespace
}  // namespace argil::io
