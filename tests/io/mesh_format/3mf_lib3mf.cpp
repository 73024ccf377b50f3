// SPDX-License-Identifier: GPL-3.0-or-later
// The 3MF consortium's own library as the other side: it reads what we write, we read what it
// writes.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/io/export.h"
#include "argil/io/mesh_file.h"
#include "argil/io/mesh_frame.h"

#include "io/support/lib3mf_file.h"
#include "io/support/lib3mf_handle.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using namespace NMR;  // NOLINT: the C functions live there
using test::ScratchFolder;

template <class Handle>
using Owned = test::Lib3mfHandle<Handle>;

TEST(WriteThreemf, IsReadByLib3mfAsOneManifoldMeshInMillimetres) {
  const ScratchFolder folder;
  const TriangleMesh mesh = test::torus_mesh(20.0, 7.0, 60, 30);
  WriteOptions options;
  options.title = "a < b & \"c\"";
  ASSERT_TRUE(write_mesh(folder / "a.3mf", mesh, options));
  const test::Lib3mfFile file = test::lib3mf_file(folder / "a.3mf");
  ASSERT_TRUE(file.is_read);
  ASSERT_EQ(file.objects.size(), 1U);
  const test::Lib3mfObject& object = file.objects[0];
  EXPECT_EQ(object.vertices, static_cast<std::int64_t>(mesh.positions.size()));
  EXPECT_EQ(object.triangles, static_cast<std::int64_t>(mesh.triangles.size()));
  EXPECT_TRUE(object.manifold);
  EXPECT_NEAR(object.box_mm.size().x, 54.0, 1e-5);
  EXPECT_EQ(file.items, 1);
  EXPECT_FALSE(file.moves);
}

/// The text of these is deflated in several pieces.
TEST(WriteThreemf, IsReadByLib3mfWhereItIsLong) {
  const ScratchFolder folder;
  const TriangleMesh mesh = test::ball_mesh(20.0, 6);
  ASSERT_TRUE(write_mesh(folder / "a.3mf", mesh));
  const test::Lib3mfFile file = test::lib3mf_file(folder / "a.3mf");
  ASSERT_TRUE(file.is_read);
  ASSERT_EQ(file.objects.size(), 1U);
  EXPECT_EQ(file.objects[0].vertices, static_cast<std::int64_t>(mesh.positions.size()));
  EXPECT_EQ(file.objects[0].triangles, static_cast<std::int64_t>(mesh.triangles.size()));
  EXPECT_TRUE(file.objects[0].manifold);
}

TEST(WriteThreemf, CarriesTheCertificateAsMetadata) {
  const ScratchFolder folder;
  ClayOptions voxels;
  voxels.voxel_mm = 0.25;
  const Clay clay = Clay::ball(5.0, voxels).value();
  ExportOptions options;
  options.triangles = 500;
  const auto report = export_mesh(folder / "a.3mf", clay, options);
  ASSERT_TRUE(report) << report.error().message;
  test::Lib3mfFile file = test::lib3mf_file(folder / "a.3mf");
  ASSERT_TRUE(file.is_read);
  for (const auto& [name, value] : metadata_of(report.value().certificate)) {
    // lib3mf puts the name of the namespace in the place of its prefix.
    EXPECT_EQ(file.metadata["urn:argil:certificate:" + name.substr(6)], value) << name;
  }
  EXPECT_EQ(file.metadata["urn:argil:certificate:units"], "mm");
  EXPECT_EQ(file.metadata["urn:argil:certificate:triangles"],
            std::to_string(report.value().triangles));
  EXPECT_EQ(std::stod(file.metadata["urn:argil:certificate:field_to_mesh_max_mm"]),
            report.value().certificate.error.field_to_mesh.max_mm);
}

/// Row i of m_fFields is the i-th coordinate of p * M: a turn or mirror, and the shift.
MODELTRANSFORM transform(const std::array<std::array<float, 4>, 3>& rows) {
  MODELTRANSFORM result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) result.m_fFields[i][j] = rows[i][j];
  }
  return result;
}

TEST(ReadThreemf, HonoursUnitComponentsAndTransformsOfLib3mf) {
  const ScratchFolder folder;
  Owned<PLib3MFModel> model;
  ASSERT_EQ(lib3mf_createmodel(model.out()), 0U);
  ASSERT_EQ(lib3mf_model_setunit(model, MODELUNIT_INCH), 0U);
  Owned<PLib3MFModelMeshObject> box;
  ASSERT_EQ(lib3mf_model_addmeshobject(model, box.out()), 0U);
  const TriangleMesh mesh = test::box_mesh({1, 2, 3});
  std::vector<MODELMESHVERTEX> vertices;
  for (const Vec3& p : mesh.positions) {
    vertices.push_back(
        {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}});
  }
  std::vector<MODELMESHTRIANGLE> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}});
  ASSERT_EQ(lib3mf_meshobject_setgeometry(box, vertices.data(), 8, triangles.data(), 12), 0U);
  // Two boxes in a group, one of them mirrored and 10 inches along x; the group turned a quarter
  // about z and lifted by 5 inches.
  Owned<PLib3MFModelComponentsObject> group;
  ASSERT_EQ(lib3mf_model_addcomponentsobject(model, group.out()), 0U);
  Owned<PLib3MFModelComponent> first;
  Owned<PLib3MFModelComponent> second;
  MODELTRANSFORM mirrored = transform({{{-1, 0, 0, 10}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  ASSERT_EQ(lib3mf_componentsobject_addcomponent(group, box, nullptr, first.out()), 0U);
  ASSERT_EQ(lib3mf_componentsobject_addcomponent(group, box, &mirrored, second.out()), 0U);
  MODELTRANSFORM turned = transform({{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 5}}});
  Owned<PLib3MFModelBuildItem> item;
  ASSERT_EQ(lib3mf_model_addbuilditem(model, group, &turned, item.out()), 0U);
  Owned<PLib3MFModelWriter> writer;
  ASSERT_EQ(lib3mf_model_querywriter(model, "3mf", writer.out()), 0U);
  ASSERT_EQ(lib3mf_writer_writetofileutf8(writer, (folder / "b.3mf").c_str()), 0U);

  const Result<TriangleMesh> read = read_mesh(folder / "b.3mf");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().triangles.size(), 24U);
  const double inch = 25.4;
  EXPECT_NEAR(signed_volume(read.value()), 2 * 6 * inch * inch * inch, 1e-6);
  const Box3 box_mm = bounds(read.value());
  EXPECT_NEAR(box_mm.min.x, -1 * inch, 1e-9);
  EXPECT_NEAR(box_mm.max.x, 1 * inch, 1e-9);
  EXPECT_NEAR(box_mm.min.y, -0.5 * inch, 1e-9);
  EXPECT_NEAR(box_mm.max.y, 10.5 * inch, 1e-9);
  EXPECT_NEAR(box_mm.min.z, 3.5 * inch, 1e-9);
  const FrameReport stated = read_framed_mesh(folder / "b.3mf").value().frame;
  EXPECT_EQ(stated.unit, LengthUnit::in);
  EXPECT_EQ(stated.unit_source, FrameSource::file);
  // What is said counts more than what is stated.
  const TriangleMesh in_mm = read_framed_mesh(folder / "b.3mf", {LengthUnit::mm, {}}).value().mesh;
  EXPECT_NEAR(bounds(in_mm).max.y, 10.5, 1e-9);
}

}  // namespace
}  // namespace argil::io
