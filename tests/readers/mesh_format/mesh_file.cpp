// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_file.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/mesh/rounding.h"

#include "mesh_format/mesh_write.h"
#include "support/bytes/mesh_bytes.h"
#include "support/mesh_samples.h"
#include "support/models.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::fill;
using test::ScratchFolder;
using testing::HasSubstr;

/// What reading a file of this name and content gives.
Result<TriangleMesh> read_text(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  fill(folder / name, content);
  return read_mesh(folder / name);
}

std::string error_of(const std::string& name, const std::string& content) {
  const Result<TriangleMesh> read = read_text(name, content);
  if (read) return "no error";
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  return read.error().message;
}

std::string binary_stl(std::uint32_t count, const std::vector<float>& coordinates) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as many programs do
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t i = 0; i < coordinates.size(); i += 9) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&coordinates[i]), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(ReadMesh, GivesTheSameTetrahedronFromEveryFormat) {
  for (const test::MeshSample& sample : test::mesh_samples()) {
    const Result<TriangleMesh> mesh =
        sample.parse(std::as_bytes(std::span(sample.bytes)), sample.name);
    ASSERT_TRUE(mesh) << sample << ": " << mesh.error().message;
    EXPECT_EQ(mesh.value().positions.size(), 4U) << sample;
    EXPECT_EQ(mesh.value().triangles.size(), 4U) << sample;
    EXPECT_DOUBLE_EQ(signed_volume(mesh.value()), 12.5 * 11.25 * 10 / 6) << sample;
    EXPECT_EQ(bounds(mesh.value()).max, (Vec3{12.5, 11.25, 10})) << sample;
  }
}

TEST(ReadMesh, NamesTheKnownEndingsForAnUnknownOne) {
  EXPECT_THAT(error_of("a.step", "x"),
              HasSubstr("'.step' is not a mesh format known here; use .obj"));
  EXPECT_THAT(error_of("a", "x"), HasSubstr("use .obj"));
}

TEST(ReadMesh, SaysWhyAFileCannotBeOpened) {
  const Result<TriangleMesh> read = read_mesh("no/such.obj");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::disk);
  EXPECT_THAT(read.error().message, HasSubstr("cannot read 'no/such.obj': No such file"));
  EXPECT_EQ(read_mesh(ScratchFolder().path() / "x.stl").error().kind, ErrorKind::disk);
}

TEST(ReadMesh, RefusesEmptyFiles) {
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.glb", "a.3mf"}) {
    EXPECT_THAT(error_of(name, ""), HasSubstr("is empty")) << name;
  }
}

TEST(ReadMesh, RefusesMeshesWithoutTriangles) {
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\nv 1 0 0\n"), HasSubstr("has no triangles"));
  EXPECT_THAT(error_of("a.stl", "solid a\nendsolid a\n"), HasSubstr("has no triangles"));
  EXPECT_THAT(error_of("a.stl", binary_stl(0, {})), HasSubstr("has no triangles"));
  EXPECT_THAT(error_of("a.ply",
                       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                       "property float y\nproperty float z\nend_header\n0 0 0\n"),
              HasSubstr("has no triangles"));
}

TEST(ReadMesh, KeepsLargeAndTinyCoordinates) {
  const Result<TriangleMesh> mesh =
      read_text("a.obj", "v 1e6 0 0\nv 0 1e-12 0\nv 0 0 1e-400\nf 1 2 3\n");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh.value().positions[0].x, 1e6);
  EXPECT_EQ(mesh.value().positions[1].y, 1e-12);
  EXPECT_EQ(mesh.value().positions[2].z, 0.0);
}

TEST(ReadObj, SplitsPolygonsIntoFans) {
  const Result<TriangleMesh> mesh =
      read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

/// All triangles look up, and cover the polygon once.
void expect_covered(const std::string& obj, std::size_t triangles, double area) {
  const Result<TriangleMesh> mesh = read_text("a.obj", obj);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles.size(), triangles);
  double sum = 0.0;
  for (const Triangle& t : mesh.value().triangles) {
    const auto& p = mesh.value().positions;
    const Vec3 twice = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    EXPECT_GT(twice.z, 0.0);
    sum += 0.5 * twice.z;
  }
  EXPECT_NEAR(sum, area, 1e-12);
}

TEST(ReadObj, CoversPolygonsWhoseCornersPointInwards) {
  expect_covered("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 4 1 2 3\n", 2, 1.0);
  expect_covered("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 1 2 3 4\n", 2, 1.0);
  // An L, begun where a fan would leave it.
  expect_covered("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 2 3 4 5 6 1\n", 4, 3.0);
  // A square with a hole: there and back along one edge.
  expect_covered(
      "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
      "f 1 2 3 4 1 5 6 7 8 5\n",
      8, 8.0);
  expect_covered("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1 2 3 1 2 3\n", 1, 0.5);
}

TEST(ReadObj, TakesAFanWhereEdgesCross) {
  const Result<TriangleMesh> star =
      read_text("a.obj", "v 0 3 0\nv -2 -2 0\nv 3 1 0\nv -3 1 0\nv 2 -2 0\nf 1 2 3 4 5\n");
  ASSERT_TRUE(star);
  EXPECT_EQ(star.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(ReadObj, RefusesMoreCornersThanAnyProgramMakes) {
  std::string face = "f";
  for (int i = 0; i < 133334; ++i) face += " 1 2 3";
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + face + "\n"),
              HasSubstr("a.obj:4: a face has 400002 corners, and at most 100000 are possible"));
}

TEST(ReadObj, NamesTheLineOfWhatIsWrong) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(error_of("a.obj", start + "f 1 2 4\n"),
              HasSubstr("a.obj:4: a face names vertex 4 of only 3"));
  EXPECT_THAT(error_of("a.obj", start + "f 1 2 -4\n"),
              HasSubstr("a.obj:4: a face names vertex -4"));
  EXPECT_THAT(error_of("a.obj", start + "f 1 2 0\n"), HasSubstr("a.obj:4: '0' does not name"));
  EXPECT_THAT(error_of("a.obj", start + "\nf 1 2\n"), HasSubstr("a.obj:5: a face needs three"));
  EXPECT_THAT(error_of("a.obj", "v 0 0\n"), HasSubstr("a.obj:1: a vertex needs three numbers"));
  EXPECT_THAT(error_of("a.obj", "v 0 0 1,5\n"), HasSubstr("'1,5' is not a number"));
  EXPECT_THAT(error_of("a.obj", start + "f 1 2 99999999999\n"), HasSubstr("beyond 4294967294"));
  EXPECT_THAT(error_of("a.obj", std::string("\0\1\2", 3)), HasSubstr("this is not text"));
}

TEST(ReadObj, RefusesNanAndInfinity) {
  for (const char* bad : {"nan", "-NaN", "inf", "-Infinity", "1e999"}) {
    EXPECT_THAT(error_of("a.obj", std::string("v 0 0 0\nv 0 ") + bad + " 0\n"),
                HasSubstr("a.obj:2: a coordinate is NaN or infinite"))
        << bad;
  }
}

TEST(ReadStl, TellsBinaryFromAsciiBySizeNotByTheWordSolid) {
  const Result<TriangleMesh> mesh = read_text("a.stl", binary_stl(1, {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles.size(), 1U);
}

TEST(ReadStl, WeldsEqualBitsAndBothZeros) {
  const Result<TriangleMesh> mesh =
      read_text("a.stl", binary_stl(2, {0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0F, 0, 0, 0, 1, 0, 0, 0, 1}));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh.value().positions.size(), 4U);
}

TEST(ReadStl, RefusesACountThatLies) {
  const std::vector<float> one{0, 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT_THAT(
      error_of("a.stl", binary_stl(2, one)),
      HasSubstr("a.stl: byte 80: the header promises 2 triangles, which take 184 bytes, but "
                "the file has 134"));
  EXPECT_THAT(error_of("a.stl", binary_stl(4000000000U, one)), HasSubstr("promises 4000000000"));
  EXPECT_THAT(error_of("a.stl", binary_stl(0, one)), HasSubstr("promises 0"));
}

TEST(ReadStl, NamesTheByteOfANan) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error_of("a.stl", binary_stl(1, {0, 0, 0, 1, nan, 0, 0, 1, 0})),
              HasSubstr("a.stl: byte 108: a coordinate of triangle 1 is NaN"));
}

/// Vertices are numbered by the first triangle that has them, and the first fault is told, also
/// where many triangles are read at once.
TEST(ReadStl, OfManyTrianglesIsAsOfFew) {
  constexpr std::uint32_t kCount = 300'000;
  std::vector<float> strip;
  for (std::uint32_t t = 0; t < kCount; ++t) {
    // Every corner but two is one of the triangle before.
    for (std::uint32_t corner = t; corner < t + 3; ++corner) {
      strip.insert(strip.end(),
                   {1e-3F * static_cast<float>(corner), static_cast<float>(corner % 2), 0.0F});
    }
  }
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Result<TriangleMesh> mesh = read_text("a.stl", binary_stl(kCount, strip));
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh.value().positions.size(), kCount + 2);
    for (std::uint32_t t = 0; t < kCount; ++t) {
      ASSERT_EQ(mesh.value().triangles[t], (Triangle{t, t + 1, t + 2}));
    }
  }
  strip[9 * 20'000] = std::numeric_limits<float>::quiet_NaN();
  strip[9 * 290'000] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error_of("a.stl", binary_stl(kCount, strip)), HasSubstr("of triangle 20001 is NaN"));
}

TEST(ReadStl, NamesTheLineInAscii) {
  EXPECT_THAT(error_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
              HasSubstr("a.stl:4: 'x' is not a number"));
  EXPECT_THAT(error_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
              HasSubstr("the file ends where 'vertex' should follow"));
}

std::string ply_header(const std::string& counts) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face " +
         counts + "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(ReadPly, NamesWhatIsWrong) {
  const std::string vertices = "0 0 0 1 0 0 0 1 0\n";
  EXPECT_THAT(error_of("a.ply", ply_header("1") + vertices + "3 0 1 3"),
              HasSubstr("a face names vertex 3 (from 0) of only 3"));
  EXPECT_THAT(error_of("a.ply", ply_header("1") + vertices + "3 0 1 -1"), HasSubstr("below 0"));
  EXPECT_THAT(error_of("a.ply", ply_header("1") + "0 0 nan 1 0 0 0 1 0 3 0 1 2"),
              HasSubstr("a coordinate of vertex 1 is NaN"));
  EXPECT_THAT(error_of("a.ply", ply_header("1") + vertices + "3 0 1"),
              HasSubstr("'vertex_indices' of face 1 of 1; the file is cut off"));
  EXPECT_THAT(error_of("a.ply", ply_header("1") + vertices + "3 0 1 2 7"),
              HasSubstr("more data than the header promises"));
  EXPECT_THAT(error_of("a.ply", ply_header("-1")), HasSubstr("a.ply:7: element 'face'"));
  EXPECT_THAT(error_of("a.ply", "plx\n"), HasSubstr("a.ply:1: the first line must be 'ply'"));
}

TEST(ReadPly, BelievesNoCountTheFileCannotHold) {
  EXPECT_THAT(error_of("a.ply", ply_header("900000000000000000") + "0 0 0 1 0 0 0 1 0\n"),
              HasSubstr("promises 900000000000000000 of 'face', more than"));
}

TEST(ReadThreemf, RefusesAZipThatIsNoModel) {
  const ScratchFolder folder;
  EXPECT_THAT(error_of("a.3mf", "PK this is no zip"), HasSubstr("not a ZIP archive, or cut off"));
}

/// A GLB around this JSON and the bytes of these vertices, by default two triangles' corners.
std::string glb_text(std::string json,
                     const std::vector<std::array<float, 3>>& vertices = {
                         {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}) {
  std::string binary(vertices.size() * sizeof vertices[0], '\0');
  std::memcpy(binary.data(), vertices.data(), binary.size());
  return test::glb_file(std::move(json), std::move(binary));
}

/// Two triangles without indices; `nodes` is what the test is about.
std::string glb_with_nodes(const std::string& nodes, const std::string& mode = "4") {
  return glb_text(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" +
                  nodes + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                  mode +
                  R"(}]}],"buffers":[{"byteLength":72}],)"
                  R"("bufferViews":[{"buffer":0,"byteLength":72}],"accessors":[)"
                  R"({"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"}]})");
}

TEST(ReadGlb, PlacesNodesInMmAndWeldsWhatWasSplit) {
  const ScratchFolder folder;
  fill(folder / "a.glb",
       glb_with_nodes(R"([{"children":[1],"translation":[0,0.5,0]},)"
                      R"({"mesh":0,"rotation":[0,0,0.70710678118654752,0.70710678118654752],)"
                      R"("scale":[2,1,1]}])"));
  const Result<TriangleMesh> read = read_mesh(folder / "a.glb");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().triangles.size(), 2U);
  ASSERT_EQ(read.value().positions.size(), 4U);
  // x: scaled by 2, turned to y, half a metre up; y up is z in mm.
  EXPECT_NEAR(length(read.value().positions[1] - Vec3{0, 0, 2500}), 0.0, 1e-9);
  EXPECT_NEAR(length(read.value().positions[3] - Vec3{0, -1000, 500}), 0.0, 1e-9);
}

/// With its place and value, in each format.
TEST(ReadMesh, RefusesWhatLiesBeyondAKilometre) {
  EXPECT_THAT(
      error_of("a.obj", "v 0 0 0\nv 0 -1e7 0\n"),
      testing::AllOf(HasSubstr("a.obj:2: a coordinate is 1e+07 mm"), HasSubstr("at most 1e+06")));
  EXPECT_THAT(error_of("a.stl", binary_stl(1, {0, 0, 0, 1, 3e38F, 0, 0, 1, 0})),
              HasSubstr("byte 108: a coordinate of triangle 1 is 3e+38 mm"));
  EXPECT_THAT(error_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2e6\n"),
              HasSubstr("a.stl:4: a coordinate is 2e+06 mm"));
  EXPECT_THAT(error_of("a.ply", ply_header("1") + "0 0 0 1 0 0 0 1e9 0 3 0 1 2\n"),
              HasSubstr("a coordinate of vertex 3 is 1e+09 mm"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"mesh":0,"translation":[3.4e38,0,0]}])")),
              HasSubstr("vertex 0 of a mesh, as its node places it: a coordinate is"));
}

TEST(ReadGlb, RefusesWhatItDoesNotUnderstand) {
  EXPECT_THAT(error_of("a.glb", "not glTF, but long enough for one"), HasSubstr("binary glTF"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"mesh":0}])", "7")), HasSubstr("mode 7"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"mesh":0}])", "1")), HasSubstr("triangles"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"children":[0,0]}])")), HasSubstr("node"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"mesh":7}])")), HasSubstr("not glTF as"));
  std::string cut = glb_with_nodes(R"([{"mesh":0}])");
  cut.resize(cut.size() - 4);
  EXPECT_THAT(error_of("a.glb", cut), HasSubstr("truncated"));
}

TEST(ReadGlb, RefusesJsonThatNestsWithoutEnd) {
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_THAT(error_of("a.glb", glb_text("{\"scenes\":[{\"nodes\":" + deep + "}]}")),
              HasSubstr("a.glb: byte 20: nests more than 64 deep"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes("[{\"children\":" + deep + "}]")),
              HasSubstr("a.glb: byte 20: nests more than 64 deep"));
  EXPECT_THAT(error_of("a.glb", glb_text("[]")), HasSubstr("byte 20: is []; must be a JSON"));
  EXPECT_THAT(error_of("a.glb", glb_with_nodes(R"([{"children":7}])")), HasSubstr("not glTF as"));
}

/// `nodes` nodes with one mesh, of `primitives` of this kind that share one list of vertices.
std::string glb_with_many(std::size_t nodes, std::size_t primitives, const std::string& primitive,
                          const std::vector<std::array<float, 3>>& vertices) {
  const auto list = [](std::size_t count, const auto& item) {
    std::string text = "[";
    for (std::size_t n = 0; n < count; ++n) text += (n > 0 ? "," : "") + item(n);
    return text + "]";
  };
  const std::string bytes = std::to_string(vertices.size() * sizeof vertices[0]);
  return glb_text(
      R"({"scenes":[{"nodes":)" + list(nodes, [](std::size_t n) { return std::to_string(n); }) +
          R"(}],"nodes":)" +
          list(nodes,
               [](std::size_t n) {
                 return R"({"mesh":0,"translation":[)" +
                        std::to_string(0.001 * static_cast<double>(n)) + ",0,0]}";
               }) +
          R"(,"meshes":[{"primitives":)" +
          list(primitives, [&](std::size_t) { return primitive; }) +
          R"(}],"bufferViews":[{"byteLength":)" + bytes +
          R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
          std::to_string(vertices.size()) +
          R"(},{"bufferView":0,"componentType":5125,"type":"SCALAR","count":0}]})",
      vertices);
}

TEST(ReadGlb, RefusesPrimitivesPlacedWithoutEnd) {
  const std::string points = R"({"mode":0})";
  const std::vector<std::array<float, 3>> one(1);
  EXPECT_THAT(error_of("a.glb", glb_with_many(1000, 1000, points, one)),
              HasSubstr("has no triangles"));
  EXPECT_THAT(error_of("a.glb", glb_with_many(1000, 1001, points, one)),
              HasSubstr("its nodes place more than 1000000 primitives"));
}

/// Lists without triangles of their own, which were not counted: hours from a file of some MB.
TEST(ReadGlbSlow, RefusesVerticesPlacedWithoutEnd) {
  const std::vector<std::array<float, 3>> vertices(100'000);
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  EXPECT_THAT(error_of("a.glb", glb_with_many(1001, 1, primitive, vertices)),
              HasSubstr("more than 100000000 vertices"));
  // One list for the primitives of many materials is worked through once.
  EXPECT_THAT(error_of("a.glb", glb_with_many(1, 1001, primitive, vertices)),
              HasSubstr("has no triangles"));
}

// The bit-for-bit comparison of what is read back with what was given, rounded to float.
void expect_every_format_reads_back(const TriangleMesh& given) {
  const ScratchFolder folder;
  const TriangleMesh rounded = mesh::rounded_to_float(given);
  for (const char* name : {"a.obj", "a.ply", "a.glb", "a.3mf"}) {
    ASSERT_TRUE(write_mesh(folder / name, given));
    Result<TriangleMesh> back = read_mesh(folder / name);
    ASSERT_TRUE(back) << back.error().message;
    // Text holds the shortest decimal of a float, which as a double differs in its last bits.
    EXPECT_EQ(mesh::rounded_to_float(back.value()).positions, rounded.positions) << name;
    EXPECT_EQ(back.value().triangles, rounded.triangles) << name;
  }
  ASSERT_TRUE(write_mesh(folder / "a.STL", given));
  const Result<TriangleMesh> back = read_mesh(folder / "a.STL");
  ASSERT_TRUE(back);
  ASSERT_EQ(back.value().triangles.size(), given.triangles.size());
  EXPECT_EQ(back.value().positions.size(), given.positions.size());
  for (std::size_t i = 0; i < given.triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(back.value().positions[back.value().triangles[i][c]],
                rounded.positions[given.triangles[i][c]] + Vec3{});
    }
  }
}

TEST(WriteMesh, ReadsBackEveryFormatBitForBit) {
  expect_every_format_reads_back(test::torus_mesh(20.0, 7.0, 48, 31));
}

/// Of a size that files are written, and STL is read, in several pieces.
TEST(WriteMesh, ReadsBackInSeveralPiecesBitForBit) {
  expect_every_format_reads_back(test::ball_mesh(10.0, 6));
}

/// In files of several pieces, the last of them not whole.
TEST(WriteMeshGolden, GivesTheSameBytesForAnyThreads) {
  const ScratchFolder folder;
  const TriangleMesh mesh = test::ball_mesh(10.0, 6);
  for (const std::string ending : {".obj", ".ply", ".glb", ".3mf", ".stl"}) {
    for (const std::size_t threads : {1, 2, 7}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      ASSERT_TRUE(write_mesh(folder / (std::to_string(threads) + ending), mesh));
    }
    const std::string alone = test::content_of(folder / ("1" + ending));
    EXPECT_EQ(test::content_of(folder / ("2" + ending)), alone) << ending;
    EXPECT_EQ(test::content_of(folder / ("7" + ending)), alone) << ending;
  }
}

TEST(WriteMesh, WritesUnitNormalsInStl) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "a.stl", test::box_mesh({10, 20, 30})));
  const std::string bytes = test::content_of(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84U + 12U * 50U);
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof normal);  // the first triangle lies at z = -15
  EXPECT_EQ(normal[0], 0.0F);
  EXPECT_EQ(normal[1], 0.0F);
  EXPECT_EQ(normal[2], -1.0F);
}

TEST(WriteMesh, RefusesWhatCannotBeWrittenAndLeavesNoFile) {
  const ScratchFolder folder;
  TriangleMesh mesh = test::box_mesh({1, 1, 1});
  mesh.positions[0].x = 1e39;
  EXPECT_THAT(write_mesh(folder / "a.stl", mesh).error().message, HasSubstr("beyond what a float"));
  mesh.triangles[0][0] = 99;
  EXPECT_EQ(write_mesh(folder / "a.obj", mesh).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(write_mesh(folder / "a.obj", {}).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(write_mesh(folder / "a.xyz", test::box_mesh({1, 1, 1})).error().kind,
            ErrorKind::bad_input);
  EXPECT_TRUE(folder.names().empty());
}

TEST(WriteMesh, StopsWhenProgressSaysSoAndKeepsTheOldFile) {
  const ScratchFolder folder;
  for (const char* name : {"a.obj", "a.ply", "a.glb", "a.3mf", "a.stl"}) {
    fill(folder / name, "old");
    const Result<void> written =
        write_mesh(folder / name, test::ball_mesh(10.0, 7), {},
                   [](std::string_view, double fraction) { return fraction < 0.5; });
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::interrupted);
    EXPECT_EQ(test::content_of(folder / name), "old");
  }
  EXPECT_EQ(folder.names().size(), 5U);
}

TEST(ReadMesh, ReadsTheSharedModelsWhole) {
  const std::vector<std::pair<std::string, std::size_t>> models{
      {"spot.obj", 5856}, {"rocker-arm.obj", 20088}, {"fandisk.obj", 12946},
      {"cow.obj", 5804},  {"teapot.obj", 6320},      {"stanford-bunny.obj", 69451}};
  for (const auto& [name, triangles] : models) {
    const auto file = test::find_model(name);
    if (!file) GTEST_SKIP() << test::missing_model(name);
    const Result<TriangleMesh> mesh = read_mesh(*file);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh.value().triangles.size(), triangles) << name;
  }
}

}  // namespace
}  // namespace argil::io
