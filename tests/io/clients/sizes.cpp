// SPDX-License-Identifier: GPL-3.0-or-later
// One size in every format: what each program outside says a piece of 80 mm measures.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "argil/engine/import.h"
#include "argil/io/export.h"
#include "argil/io/mesh_file.h"
#include "argil/io/volume_file.h"
#include "argil/mesh/close.h"

#include "io/support/lib3mf_file.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/models.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

constexpr double kClientSizeMm = 80.0;
double voxel_mm() { return test::effort(1.0, 0.25); }
constexpr double kAllowedMm = 0.05;

double longest_side(const Vec3& size) { return std::max({size.x, size.y, size.z}); }

/// As `argil import --size-mm 80` does.
Clay imported(const std::filesystem::path& file) {
  TriangleMesh mesh = read_mesh(file).value();
  const double scale = kClientSizeMm / longest_side(bounds(mesh).size());
  for (Vec3& p : mesh.positions) p *= scale;
  return std::move(
      import_mesh(mesh::close_mesh(mesh).value().mesh, ClayOptions{.voxel_mm = voxel_mm()})
          .value()
          .clay);
}

/// "Min X = -1.5, Max X = 2.5", a line for each axis.
Vec3 size_of_admesh(const std::filesystem::path& stl) {
  const std::string said = test::run_program({"admesh", stl.string()}).output;
  const auto number_of = [&](const std::string& label) {
    const std::size_t at = said.find(label + " =");
    return at == std::string::npos ? std::nan("") : std::atof(said.c_str() + at + label.size() + 2);
  };
  return {number_of("Max X") - number_of("Min X"), number_of("Max Y") - number_of("Min Y"),
          number_of("Max Z") - number_of("Min Z")};
}

/// In metres, y up: the bounds that the file states, which Khronos' validator holds against the
/// vertices, taken through the node.
Vec3 size_of_glb_m(const std::filesystem::path& glb) {
  const std::string bytes = test::content_of(glb);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof length);
  const auto json = nlohmann::json::parse(bytes.substr(20, length));
  const auto& position = json["accessors"][0];
  const auto& matrix = json["nodes"][0]["matrix"];
  Vec3 size;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent =
          position["max"][axis].get<double>() - position["min"][axis].get<double>();
      size[row] += std::abs(matrix[4 * axis + row].get<double>()) * extent;
    }
  }
  return size;
}

Vec3 size_of_openmesh(const std::filesystem::path& ply) {
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, ply.string()));
  Box3 box;
  for (const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    box.include({double{p[0]}, double{p[1]}, double{p[2]}});
  }
  return box.size();
}

/// "Dimensions of active voxels:   263 x 262 x 205" and "voxel size: 0.312": nodes of the band,
/// whose outermost lie two to three voxels off the surface at either end.
Vec3 size_of_vdb_print(const std::filesystem::path& vdb) {
  const std::string said = test::run_program({"vdb_print", "-l", vdb.string()}).output;
  const std::string label = "Dimensions of active voxels:";
  const std::size_t dimensions = said.find(label);
  const std::size_t voxel = said.find("voxel size:");
  if (dimensions == std::string::npos || voxel == std::string::npos)
    return Vec3{1, 1, 1} * std::nan("");
  Vec3 nodes;
  EXPECT_EQ(std::sscanf(said.c_str() + dimensions + label.size(), "%lf x %lf x %lf", &nodes.x,
                        &nodes.y, &nodes.z),
            3)
      << said;
  const double voxel_mm = std::atof(said.c_str() + voxel + std::strlen("voxel size:"));
  const double beyond = 1.0 + 2.0 * 2.5;
  return voxel_mm * (nodes - Vec3{beyond, beyond, beyond});
}

TEST(SizeClient, BunnyOf80MmHas80MmInEveryProgram) {
  for (const char* program : {"prusa-slicer", "admesh", "vdb_print", "node"}) {
    ARGIL_CLIENT_OR_SKIP(program);
  }
  if (!std::filesystem::exists(test::gltf_validator())) {
    GTEST_SKIP() << "client gltf-validator of npm is not installed; ./tests/run.sh installs it";
  }
  ARGIL_MODEL_OR_SKIP(bunny, "stanford-bunny.obj");
  const Clay clay = imported(bunny);
  const test::ScratchFolder folder;
  for (const char* name : {"b.3mf", "b.stl", "b.obj", "b.ply", "b.glb"}) {
    const auto report = export_mesh(folder / name, clay);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_NEAR(longest_side(report.value().verdict.size_mm), kClientSizeMm, kAllowedMm) << name;
  }
  ASSERT_TRUE(export_volume(folder / "b.vdb", clay));

  for (const char* name : {"b.3mf", "b.stl", "b.obj"}) {
    const Vec3 size = test::slicer_info(folder / name).size_mm;
    EXPECT_NEAR(longest_side(size), kClientSizeMm, kAllowedMm) << "prusa-slicer " << name;
  }
  EXPECT_NEAR(longest_side(size_of_admesh(folder / "b.stl")), kClientSizeMm, kAllowedMm)
      << "admesh";
  const test::Lib3mfFile threemf = test::lib3mf_file(folder / "b.3mf");
  ASSERT_TRUE(threemf.is_read);
  ASSERT_EQ(threemf.objects.size(), 1U);
  EXPECT_FALSE(threemf.moves);
  EXPECT_NEAR(longest_side(threemf.objects[0].box_mm.size()), kClientSizeMm, kAllowedMm)
      << "lib3mf";
  EXPECT_NEAR(longest_side(size_of_openmesh(folder / "b.ply")), kClientSizeMm, kAllowedMm)
      << "OpenMesh";
  EXPECT_THAT(test::gltf_complaints(folder / "b.glb"), testing::IsEmpty());
  EXPECT_NEAR(1000.0 * longest_side(size_of_glb_m(folder / "b.glb")), kClientSizeMm, kAllowedMm)
      << "glTF";
  EXPECT_NEAR(longest_side(size_of_vdb_print(folder / "b.vdb")), kClientSizeMm,
              kAllowedMm + voxel_mm())
      << "vdb_print";
}

}  // namespace
}  // namespace argil::io
