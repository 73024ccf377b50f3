// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs of a print shop say about written files. Suites end in Client, their label.
#include "support/clients.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "support/effort.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::ScratchFolder;
using testing::IsEmpty;
using testing::Not;

TriangleMesh piece() { return test::torus_mesh(20.0, 7.0, 60, 30); }

/// With as many triangles, but usually fewer layers.
TriangleMesh piece_to_slice() {
  const double scale = test::effort(0.3, 1.0);
  return test::torus_mesh(20.0 * scale, 7.0 * scale, 60, 30);
}

TEST(AdmeshClient, FindsNothingToFixInAWrittenStl) {
  ARGIL_CLIENT_OR_SKIP("admesh");
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "a.stl", piece()));
  EXPECT_THAT(test::admesh_complaints(folder / "a.stl"), IsEmpty());
}

TEST(AdmeshClient, ComplainsAboutAHoleAndATurnedTriangle) {
  ARGIL_CLIENT_OR_SKIP("admesh");
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "hole.stl", test::without(piece(), 7)));
  EXPECT_THAT(test::admesh_complaints(folder / "hole.stl"), Not(IsEmpty()));
  TriangleMesh turned = piece();
  std::swap(turned.triangles[100][0], turned.triangles[100][1]);
  ASSERT_TRUE(write_mesh(folder / "turned.stl", turned));
  EXPECT_THAT(test::admesh_complaints(folder / "turned.stl"), Not(IsEmpty()));
}

TEST(SlicerClient, SeesOneManifoldPartOfTheSameSizeInEveryFormat) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  for (const char* name : {"a.stl", "a.3mf", "a.obj"}) {
    ASSERT_TRUE(write_mesh(folder / name, piece()));
    const test::SlicerInfo info = test::slicer_info(folder / name);
    EXPECT_THAT(info.complaints, IsEmpty()) << name;
    EXPECT_EQ(info.facets, 3600) << name;
    EXPECT_EQ(info.parts, 1) << name;
    EXPECT_NEAR(info.size_mm.x, 54.0, 1e-4) << name;
    EXPECT_NEAR(info.size_mm.y, 54.0, 1e-4) << name;
    EXPECT_NEAR(info.size_mm.z, bounds(piece()).size().z, 1e-4) << name;
  }
}

TEST(SlicerClient, ComplainsAboutAHoleAndATurnedTriangle) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "hole.stl", test::without(piece(), 7)));
  EXPECT_THAT(test::slicer_info(folder / "hole.stl").complaints, Not(IsEmpty()));
  TriangleMesh turned = piece();
  std::swap(turned.triangles[100][0], turned.triangles[100][1]);
  ASSERT_TRUE(write_mesh(folder / "turned.stl", turned));
  EXPECT_THAT(test::slicer_info(folder / "turned.stl").complaints, Not(IsEmpty()));
}

TEST(SlicerClient, SlicesStlAndThreemfWithoutARepair) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  for (const char* name : {"a.stl", "a.3mf"}) {
    ASSERT_TRUE(write_mesh(folder / name, piece_to_slice()));
    EXPECT_THAT(test::slicing_complaints(folder / name), IsEmpty()) << name;
  }
}

TEST(SlicerClient, ComplainsWhenThereIsNothingToSlice) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  test::fill(folder / "a.stl", "nothing");
  EXPECT_THAT(test::slicing_complaints(folder / "a.stl"), Not(IsEmpty()));
}

#define ARGIL_GLTF_OR_SKIP()                                                          \
  if (!test::has_program("node") || !std::filesystem::exists(test::gltf_validator())) \
  GTEST_SKIP() << "client gltf-validator of npm is not installed; ./tests/run.sh installs it"

TEST(GltfClient, HasNothingToSayAboutAWrittenGlb) {
  ARGIL_GLTF_OR_SKIP();
  const ScratchFolder folder;
  WriteOptions options;
  options.title = "a \"quoted\" name \xc3\xa9 \xff";
  ASSERT_TRUE(write_mesh(folder / "a.glb", piece(), options));
  EXPECT_THAT(test::gltf_complaints(folder / "a.glb"), IsEmpty());
}

TEST(GltfClient, ComplainsAboutAWrongByte) {
  ARGIL_GLTF_OR_SKIP();
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "a.glb", piece()));
  std::string bytes = test::content_of(folder / "a.glb");
  bytes[bytes.size() - 2] = 'x';
  test::fill(folder / "a.glb", bytes);
  EXPECT_THAT(test::gltf_complaints(folder / "a.glb"), Not(IsEmpty()));
}

}  // namespace
}  // namespace argil::io
