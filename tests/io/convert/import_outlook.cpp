// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/import_outlook.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "argil/core/pace.h"
#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/prepared_mesh.h"
#include "argil/mesh/triangle_geometry.h"

#include "convert/surface_samples.h"
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

/// A turned part: an upright prism of many sides, each of two slivers, its lids fans of slivers.
TriangleMesh turned(int sides, double radius, double height) {
  TriangleMesh mesh;
  mesh.positions = {{0.0, 0.0, 0.0}, {0.0, 0.0, height}};
  for (int n = 0; n < sides; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / sides;
    const Vec3 foot{radius * std::cos(angle), radius * std::sin(angle), 0.0};
    mesh.positions.push_back(foot);
    mesh.positions.push_back(foot + Vec3{0.0, 0.0, height});
  }
  for (int n = 0; n < sides; ++n) {
    const auto a = static_cast<std::uint32_t>(2 + 2 * n);
    const auto b = static_cast<std::uint32_t>(2 + 2 * ((n + 1) % sides));
    mesh.triangles.insert(mesh.triangles.end(),
                          {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  return mesh;
}

TEST(SurfaceSamples, OfThinTrianglesFollowTheirLengthAndShareTheArea) {
  constexpr int kSides = 1000;
  constexpr double kCell = 0.1;
  const TriangleMesh mesh = turned(kSides, 10.0, 50.0);
  std::int64_t count = 0;
  double area = 0.0;
  double longest = 0.0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const mesh::Corners t = mesh::corners_of(mesh, n);
    longest += mesh::longest_side(t[0], t[1], t[2]);
    io::for_each_sample(t, kCell, [&](const Vec3& at, double share) {
      EXPECT_GT(share, 0.0);
      EXPECT_LE(std::hypot(at.x, at.y), 10.0 + 1e-9);
      area += share;
      ++count;
    });
  }
  EXPECT_NEAR(area, surface_area(mesh), 1e-9 * area);
  // All are thinner than a cell: two thirds of one apart along them, and one more for each.
  EXPECT_LE(static_cast<double>(count),
            1.5 * longest / kCell + static_cast<double>(mesh.triangles.size()));
}

TEST(SurfaceSamples, LeaveNoGapWiderThanACell) {
  const mesh::Corners t{Vec3{0.0, 0.0, 0.0}, Vec3{7.0, 1.0, 0.0}, Vec3{2.0, 5.0, 0.0}};
  std::vector<Vec3> samples;
  io::for_each_sample(t, 0.5, [&](const Vec3& at, double) { samples.push_back(at); });
  const auto gap = [&](const Vec3& p) {
    double nearest = 1e9;
    for (const Vec3& at : samples) nearest = std::min(nearest, length(at - p));
    return nearest;
  };
  for (double u = 0.0; u <= 1.0; u += 0.02) {
    for (double v = 0.0; u + v <= 1.0; v += 0.02) {
      EXPECT_LT(gap(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])), 0.5) << u << " " << v;
    }
  }
}

TEST(ImportOutlookOf, TellsATurnedPartAsWellAsAnEvenMesh) {
  const Quotients off = told_over_made(turned(720, 10.0, 50.0), 200);
  EXPECT_NEAR(off.vertices, 1.0, 0.25);
  EXPECT_NEAR(off.bytes, 1.0, 0.25);
}

TEST(ImportOutlookOf, StopsWhenToldTo) {
  int told = 0;
  const Progress stops = [&](std::string_view, double) { return ++told < 3; };
  EXPECT_THROW(io::ImportOutlook(test::ball_mesh(20.0, 4), stops), Interrupted);
  EXPECT_EQ(told, 3);
}

}  // namespace
}  // namespace argil
