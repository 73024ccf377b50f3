// SPDX-License-Identifier: GPL-3.0-or-later
// A 3MF with a part for each body of the clay.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/export.h"
#include "argil/io/mesh_file.h"

#include "io/support/lib3mf_file.h"
#include "support/clients.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::box_mesh;
using test::ScratchFolder;
using testing::HasSubstr;
using testing::IsEmpty;

/// The coordinates of every triangle, in their order.
std::vector<std::array<double, 9>> corners_in_order(const TriangleMesh& mesh) {
  std::vector<std::array<double, 9>> all;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.positions[a];
    const Vec3 q = mesh.positions[b];
    const Vec3 r = mesh.positions[c];
    all.push_back({p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z});
  }
  return all;
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
    auto all = corners_in_order(mesh);
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
