// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a mesh, and a 3MF with a part for each.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/export.h"
#include "argil/io/mesh_file.h"

#include "lib3mf_file.h"
#include "mesh_bodies.h"
#include "support/clients.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ball_mesh;
using test::box_mesh;
using test::inside_out;
using test::joined;
using test::ScratchFolder;
using testing::HasSubstr;
using testing::IsEmpty;

/// Body numbers of a mesh made of balls of `splits` 1, one after the other.
std::vector<std::uint32_t> body_of_each_ball(const TriangleMesh& mesh) {
  const std::size_t each = ball_mesh(1.0, 1).triangles.size();
  const MeshBodies bodies = mesh_bodies(mesh);
  std::vector<std::uint32_t> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % each == 0) found.push_back(bodies.of_triangle[t]);
    EXPECT_EQ(bodies.of_triangle[t], found.back());
  }
  EXPECT_EQ(bodies.count, *std::max_element(found.begin(), found.end()) + 1);
  return found;
}

TEST(MeshBodies, AreNumberedByVolume) {
  const TriangleMesh mesh =
      joined(joined(ball_mesh(1, 1), ball_mesh(3, 1, {9, 0, 0})), ball_mesh(2, 1, {0, 9, 0}));
  EXPECT_THAT(body_of_each_ball(mesh), testing::ElementsAre(2, 0, 1));
}

/// A cavity goes with the innermost shell around it; what lies loose in it is a body.
TEST(MeshBodies, TakeTheirCavities) {
  TriangleMesh mesh = ball_mesh(10, 1);
  mesh = joined(mesh, inside_out(ball_mesh(8, 1)));
  mesh = joined(mesh, ball_mesh(5, 1));
  mesh = joined(mesh, inside_out(ball_mesh(3, 1)));
  mesh = joined(mesh, ball_mesh(1, 1));
  EXPECT_THAT(body_of_each_ball(mesh), testing::ElementsAre(0, 0, 1, 1, 2));
}

/// The box of a ring holds what stands in its hole.
TEST(MeshBodies, TellABoxFromWhatIsInside) {
  const TriangleMesh ring = test::torus_mesh(20, 5, 24, 12);
  const TriangleMesh shell = joined(ball_mesh(4, 1), inside_out(ball_mesh(2, 1)));
  const MeshBodies bodies = mesh_bodies(joined(ring, shell));
  EXPECT_EQ(bodies.count, 2U);
  EXPECT_EQ(bodies.of_triangle.front(), 0U);
  EXPECT_EQ(bodies.of_triangle.back(), 1U);
}

/// The coordinates of every triangle, in their order.
std::vector<std::array<double, 9>> corners(const TriangleMesh& mesh) {
  std::vector<std::array<double, 9>> all;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.positions[a];
    const Vec3 q = mesh.positions[b];
    const Vec3 r = mesh.positions[c];
    all.push_back({p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z});
  }
  return all;
}

TEST(MeshBodies, SplitIntoMeshesOfTheirOwnVertices) {
  const TriangleMesh ball = ball_mesh(3, 1, {9, 0, 0});
  const TriangleMesh mesh = joined(box_mesh({1, 1, 1}), ball);
  const auto parts = split_mesh(mesh, mesh_bodies(mesh).of_triangle);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(corners(parts[0]), corners(ball));
  EXPECT_EQ(parts[0].positions.size(), ball.positions.size());
  EXPECT_EQ(parts[1].positions.size(), 8U);
}

/// A hollow ball with a ball loose in it, and a block beside.
Clay three_bodies(const Vec3& ball = {}) {
  Box3 box;
  box.include(Vec3{-9, -9, -9});
  box.include(Vec3{21, 9 + ball.y, 9});
  const auto distance = [&](const Vec3& p) {
    const double r = length(p);
    const double shell = std::max(r - 8.0, 6.0 - r);
    const Vec3 q = p - Vec3{15, 0, 0};
    const double block = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) - 4.0;
    return std::min({shell, length(p - ball) - 3.0, block});
  };
  return Clay::from_distance(distance, box, ClayOptions{.voxel_mm = 0.5}).value();
}

TEST(ExportParts, AreObjectsOfTheirOwnHeldInPlaceByOne) {
  const ScratchFolder folder;
  ExportOptions options;
  options.parts = true;
  const auto report = export_mesh(folder / "a \"b\".3mf", three_bodies(), options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report.value().parts, 3);
  EXPECT_TRUE(report.value().verdict.printable);
  EXPECT_EQ(report.value().verdict.components, 4);
  EXPECT_EQ(report.value().verdict.cavities, 1);
  const test::Lib3mfFile file = test::lib3mf_file(folder / "a \"b\".3mf");
  ASSERT_TRUE(file.is_read);
  EXPECT_EQ(file.items, 1);
  EXPECT_FALSE(file.moves);
  EXPECT_EQ(file.components, 3);
  ASSERT_EQ(file.objects.size(), 3U);
  const double sides[] = {16.0, 8.0, 6.0};
  std::int64_t triangles = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(file.objects[i].name, "a \"b\" " + std::to_string(i + 1));
    EXPECT_TRUE(file.objects[i].manifold);
    EXPECT_NEAR(file.objects[i].box_mm.size().x, sides[i], 0.1);
    triangles += file.objects[i].triangles;
  }
  EXPECT_EQ(triangles, report.value().triangles);
  EXPECT_EQ(file.metadata.count("urn:argil:certificate:clay_hash"), 1U);
}

TEST(ExportParts, HoldTheTrianglesOfTheWhole) {
  const ScratchFolder folder;
  const Clay clay = three_bodies();
  ExportOptions options;
  options.parts = true;
  ASSERT_TRUE(export_mesh(folder / "parts.3mf", clay, options));
  ASSERT_TRUE(export_mesh(folder / "whole.3mf", clay));
  const TriangleMesh parts = read_mesh(folder / "parts.3mf").value();
  const TriangleMesh whole = read_mesh(folder / "whole.3mf").value();
  const auto sorted = [](const TriangleMesh& mesh) {
    auto all = corners(mesh);
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(sorted(parts), sorted(whole));
  EXPECT_EQ(parts.positions.size(), whole.positions.size());
}

TEST(ExportParts, AreRefusedWhereTheFormatHasNone) {
  const ScratchFolder folder;
  ExportOptions options;
  options.parts = true;
  const auto report = export_mesh(folder / "a.stl", three_bodies(), options);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(report.error().message, HasSubstr(".3mf"));
}

TEST(WriteMesh, RefusesPartsThatAreNotOneForEachTriangle) {
  const ScratchFolder folder;
  WriteOptions options;
  options.parts = {0, 1};
  const auto written = write_mesh(folder / "a.3mf", box_mesh({1, 1, 1}), options);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("2 parts for 12 triangles"));
}

/// PrusaSlicer takes the components of an object for objects.
TEST(ExportPartsClient, StandWhereTheyStoodInASlicer) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  ExportOptions options;
  options.parts = true;
  const auto report = export_mesh(folder / "a.3mf", three_bodies(), options);
  ASSERT_TRUE(report);
  const test::SlicerInfo info = test::slicer_info(folder / "a.3mf");
  EXPECT_THAT(info.complaints, IsEmpty());
  EXPECT_EQ(info.objects, 3);
  EXPECT_EQ(info.facets, report.value().triangles);
  EXPECT_NEAR(test::slicer_size_mm(folder / "a.3mf").x, 27.0, 0.1);
  EXPECT_NEAR(info.volume_mm3, report.value().verdict.volume_mm3,
              1e-4 * report.value().verdict.volume_mm3);
}

/// Beside one another, since PrusaSlicer 2.9 sets each on the bed: one within another would be
/// moved into its wall.
TEST(ExportPartsClient, AreSliced) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  ExportOptions options;
  options.parts = true;
  ASSERT_TRUE(export_mesh(folder / "a.3mf", three_bodies({0, 15, 0}), options));
  EXPECT_EQ(test::slicer_info(folder / "a.3mf").objects, 3);
  EXPECT_THAT(test::slicing_complaints(folder / "a.3mf"), IsEmpty());
}

}  // namespace
}  // namespace argil::io
