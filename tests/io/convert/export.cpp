// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/export.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/rounding.h"

#include "mesh_format/mesh_write.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ScratchFolder;

Clay ball(double radius_mm, double voxel_mm) {
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  Result<Clay> clay = Clay::ball(radius_mm, options);
  EXPECT_TRUE(clay) << clay.error().message;
  return std::move(clay).value();
}

Stroke carve(double radius_mm, const Vec3& from, const Vec3& to) {
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  stroke.samples = {{0.0, from, {}, 1.0}, {1.0, to, {}, 1.0}};
  return stroke;
}

/// A ball with a groove cut by a much smaller tool: several levels.
Clay grooved_ball(double voxel_mm = 0.1) {
  Clay clay = ball(10.0, voxel_mm);
  EXPECT_TRUE(clay.apply(carve(0.8, {-3, -3, 9.4}, {4, 1, 9.2})));
  EXPECT_TRUE(clay.apply(carve(3.0, {10, 0, 0}, {9, 4, 0})));
  return clay;
}

/// Of a grooved ball where a quarter of the triangles shows the same.
double usual_voxel_mm() { return test::effort(0.2, 0.1); }

TEST(ExportMesh, WritesAPrintableFileOfEveryFormat) {
  const ScratchFolder folder;
  const double voxel_mm = usual_voxel_mm();
  const Clay clay = grooved_ball(voxel_mm);
  for (const char* name : {"a.3mf", "a.stl", "a.obj", "a.ply", "a.glb"}) {
    const Result<ExportReport> report = export_mesh(folder / name, clay);
    ASSERT_TRUE(report) << report.error().message;
    const ExportReport& r = report.value();
    EXPECT_TRUE(r.verdict.printable) << name;
    EXPECT_EQ(r.verdict.components, 1) << name;
    EXPECT_LT(r.max_error_mm, voxel_mm) << name;
    EXPECT_LE(r.rms_error_mm, r.max_error_mm) << name;
    EXPECT_LT(std::abs(r.volume_change), 1e-6) << name;
    const Result<TriangleMesh> back = read_mesh(folder / name);
    ASSERT_TRUE(back);
    EXPECT_EQ(static_cast<std::int64_t>(back.value().triangles.size()), r.triangles) << name;
  }
  EXPECT_EQ(folder.names().size(), 5U);
}

TEST(ExportMesh, MeasuresTheErrorOfTheFileAgainstTheClay) {
  const ScratchFolder folder;
  const Clay clay = ball(10.0, 0.2);
  const Result<ExportReport> report = export_mesh(folder / "a.stl", clay);
  ASSERT_TRUE(report);
  double worst = 0.0;
  const TriangleMesh back = read_mesh(folder / "a.stl").value();
  for (const Vec3& p : back.positions) {
    worst = std::max(worst, std::abs(clay.distance_at(p)));
  }
  constexpr double kRounding = 1e-12;  // both interpolate, in another order
  EXPECT_GE(report.value().max_error_mm + kRounding, worst);
  EXPECT_GT(report.value().rms_error_mm, 0.0);
  const mesh::Certificate& certificate = report.value().certificate;
  EXPECT_EQ(certificate.proven_max_mm, 0.0) << "nothing was asked for, so nothing was proven";
  EXPECT_GT(certificate.error.mesh_to_field.samples, report.value().triangles);
  EXPECT_GT(certificate.error.field_to_mesh.samples, report.value().triangles / 2);
  // Beyond that, the clay itself may miss the ball by its tolerance.
  const double miss = report.value().max_error_mm + clay.options().tolerance_voxels * 0.2;
  const double slack = 4.0 * std::numbers::pi * 100.0 * miss;
  EXPECT_NEAR(report.value().verdict.volume_mm3, 4.0 / 3.0 * std::numbers::pi * 1000.0, slack);
}

TEST(ExportMesh, LeavesOutSpecksAndCountsThem) {
  const ScratchFolder folder;
  ClayOptions sharp{.voxel_mm = 0.1};
  sharp.edge_radius_mm = 0.0;  // or the speck that the groove leaves standing would be gone
  Clay clay = Clay::ball(10.0, sharp).value();
  ASSERT_TRUE(clay.apply(carve(0.8, {-3, -3, 9.4}, {4, 1, 9.2})));
  const mesh::MeshVerdict before = mesh::check_mesh(extract_surface(clay));
  ASSERT_GT(before.components, 1);
  const Result<ExportReport> report = export_mesh(folder / "a.stl", clay);
  ASSERT_TRUE(report);
  EXPECT_EQ(report.value().verdict.components, 1);
  EXPECT_EQ(report.value().removed_components, before.components - 1);
}

TEST(ExportMesh, GivesTheSameBytesAndFiguresEveryTime) {
  const ScratchFolder folder;
  const Clay clay = grooved_ball(usual_voxel_mm());
  const Result<ExportReport> first = export_mesh(folder / "a.3mf", clay);
  const std::string bytes = test::content_of(folder / "a.3mf");
  const Result<ExportReport> second = export_mesh(folder / "a.3mf", clay);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(test::content_of(folder / "a.3mf"), bytes);
  EXPECT_EQ(first.value().rms_error_mm, second.value().rms_error_mm);
}

TEST(ExportMesh, HasNoMoreTrianglesThanAskedAndCertifiesTheFile) {
  const ScratchFolder folder;
  const double voxel_mm = usual_voxel_mm();
  const Clay clay = grooved_ball(voxel_mm);
  const double volume = signed_volume(extract_surface(clay));
  ExportOptions options;
  options.triangles = test::effort(1250, 5000);
  for (const char* name : {"a.3mf", "a.stl", "a.obj", "a.ply"}) {
    SCOPED_TRACE(name);
    const Result<ExportReport> report = export_mesh(folder / name, clay, options);
    ASSERT_TRUE(report) << report.error().message;
    const ExportReport& r = report.value();
    EXPECT_TRUE(r.verdict.printable);
    EXPECT_LE(r.triangles, options.triangles);
    EXPECT_EQ(r.certificate.triangles, r.triangles);
    EXPECT_EQ(r.certificate.asked_triangles, options.triangles);
    EXPECT_GT(r.certificate.surface_triangles, 8 * options.triangles);
    EXPECT_EQ(r.certificate.clay_hash, clay.hash());
    EXPECT_EQ(r.max_error_mm, r.certificate.error.max_mm());
    EXPECT_LT(r.max_error_mm, voxel_mm);
    // The certificate is that of the file's own floats.
    const TriangleMesh back = mesh::rounded_to_float(read_mesh(folder / name).value());
    EXPECT_EQ(static_cast<std::int64_t>(back.triangles.size()), r.triangles);
    EXPECT_NEAR(r.volume_change, (signed_volume(back) - volume) / volume, 1e-9);
    double worst = 0.0;
    for (const Vec3& p : back.positions) worst = std::max(worst, std::abs(clay.distance_at(p)));
    EXPECT_GE(r.certificate.error.mesh_to_field.max_mm, worst - 1e-6);
  }
}

TEST(ExportMesh, KeepsTheLargestErrorAsked) {
  const ScratchFolder folder;
  const double voxel_mm = usual_voxel_mm();
  const Clay clay = grooved_ball(voxel_mm);
  ExportOptions options;
  options.max_error_mm = 0.6 * voxel_mm;
  const Result<ExportReport> report = export_mesh(folder / "a.3mf", clay, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report.value().verdict.printable);
  EXPECT_LE(report.value().max_error_mm, options.max_error_mm);
  EXPECT_EQ(report.value().certificate.proven_max_mm, options.max_error_mm);
  EXPECT_LT(report.value().triangles, test::effort(2500, 10000));
  options.max_error_mm = 1e-6;
  test::fill(folder / "b.3mf", "old");
  const Result<ExportReport> refused = export_mesh(folder / "b.3mf", clay, options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("allow at least"));
  EXPECT_EQ(test::content_of(folder / "b.3mf"), "old");
}

TEST(ExportMesh, RefusesEmptyClayAndKeepsTheOldFile) {
  const ScratchFolder folder;
  Clay clay = ball(2.0, 0.2);
  ASSERT_TRUE(clay.apply(carve(5.0, {0, 0, 0}, {0, 0, 0})));
  test::fill(folder / "a.stl", "old");
  const Result<ExportReport> report = export_mesh(folder / "a.stl", clay);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(report.error().message, testing::HasSubstr("there is no clay to export"));
  EXPECT_EQ(test::content_of(folder / "a.stl"), "old");
}

TEST(ExportMesh, RefusesAnUnknownEndingBeforeItWorks) {
  const ScratchFolder folder;
  const Result<ExportReport> report =
      export_mesh(folder / "a.step", ball(2.0, 0.2), [](std::string_view, double) {
        ADD_FAILURE() << "has begun";
        return true;
      });
  EXPECT_EQ(report.error().kind, ErrorKind::bad_input);
}

TEST(ExportMesh, StopsAtEveryStageAndKeepsTheOldFile) {
  const ScratchFolder folder;
  const Clay clay = ball(test::effort(5.0, 10.0), 0.2);
  ExportOptions fewer;
  fewer.triangles = test::effort(1250, 5000);
  for (const std::string stage : {"surface", "decimate", "measure", "write", "check"}) {
    test::fill(folder / "a.3mf", "old");
    const Result<ExportReport> report = export_mesh(
        folder / "a.3mf", clay, fewer, [&](std::string_view now, double) { return now != stage; });
    ASSERT_FALSE(report) << stage;
    EXPECT_EQ(report.error().kind, ErrorKind::interrupted) << stage;
    EXPECT_EQ(test::content_of(folder / "a.3mf"), "old") << stage;
    EXPECT_EQ(folder.names().size(), 1U) << stage;
  }
}

TEST(ExportMesh, TellsHowFarItHasComeOverAll) {
  const ScratchFolder folder;
  const Clay clay = ball(10.0, 0.2);
  for (const std::int64_t triangles : {0, 3000}) {
    ExportOptions options;
    options.triangles = triangles;
    double last = 0.0;
    std::vector<std::string> stages;
    const auto listen = [&](std::string_view stage, double fraction) {
      EXPECT_GE(fraction, last) << stage;
      EXPECT_LE(fraction, 1.0) << stage;
      last = fraction;
      if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
      return true;
    };
    ASSERT_TRUE(export_mesh(folder / "a.3mf", clay, options, listen));
    EXPECT_GT(last, 0.5);
    if (triangles == 0) {
      EXPECT_THAT(stages, testing::ElementsAre("surface", "measure", "write", "check"));
    } else {
      EXPECT_THAT(stages, testing::ElementsAre("surface", "decimate", "measure", "write", "check"));
    }
  }
}

}  // namespace
}  // namespace argil::io
