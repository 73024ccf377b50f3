// SPDX-License-Identifier: GPL-3.0-or-later
// What glTF files hold beside plain lists of triangles: strips, sparse and quantized lists, skins,
// morph targets, buffers elsewhere; and what is refused by name.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "support/bytes/mesh_bytes.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::base64;
using test::bytes_of;
using test::fill;
using test::glb_file;
using test::ScratchFolder;
using testing::AllOf;
using testing::HasSubstr;

const std::string kAsset = R"("asset":{"version":"2.0"})";

Result<TriangleMesh> read_gltf(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  fill(folder / name, content);
  return read_mesh(folder / name);
}

std::string gltf_error(const std::string& name, const std::string& content) {
  const auto read = read_gltf(name, content);
  if (read) return "no error";
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  return read.error().message;
}

std::vector<Vec3> corners(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) points.push_back(mesh.positions[v]);
  }
  return points;
}

/// One node with one mesh. `more` are further members; views are of the whole binary chunk, cut at
/// these places.
std::string one_mesh(const std::string& primitive, const std::string& accessors,
                     const std::vector<std::string>& chunks, const std::string& more = "",
                     const std::string& nodes = R"([{"mesh":0}])") {
  std::string binary;
  std::string views;
  for (const std::string& chunk : chunks) {
    views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
             std::to_string(binary.size()) + R"(,"byteLength":)" + std::to_string(chunk.size()) +
             "}";
    binary += chunk;
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
  }
  return glb_file("{" + kAsset + R"(,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
                      R"(,"meshes":[{"primitives":[)" + primitive +
                      R"(]}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) +
                      R"(}],"bufferViews":[)" + views + R"(],"accessors":[)" + accessors + "]" +
                      more + "}",
                  binary);
}

/// In millimetres of glTF's y up: (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), so that z up gives
/// (x, 0, y).
const std::string kSquare = bytes_of(0.0F, 0, 0, 1e-3F, 0, 0, 0, 1e-3F, 0, 1e-3F, 1e-3F, 0);
const std::string kSquarePoints =
    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";

TEST(ReadGltf, TurnsStripsAndFansIntoTriangles) {
  const auto strip = read_gltf(
      "a.glb", one_mesh(R"({"attributes":{"POSITION":0},"mode":5})", kSquarePoints, {kSquare}));
  ASSERT_TRUE(strip) << strip.error().message;
  EXPECT_EQ(strip.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  const std::string order = R"(,{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"})";
  const std::string fan_order = bytes_of(std::uint8_t{0}, 1, 3, 2);
  const auto fan =
      read_gltf("a.glb", one_mesh(R"({"attributes":{"POSITION":0},"indices":1,"mode":6})",
                                  kSquarePoints + order, {kSquare, fan_order}));
  ASSERT_TRUE(fan) << fan.error().message;
  EXPECT_EQ(fan.value().triangles, (std::vector<Triangle>{{1, 3, 0}, {3, 2, 0}}));
}

TEST(ReadGltf, LeavesOutTheTrianglesByWhichAStripHops) {
  const std::string order = R"(,{"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  const auto strip =
      read_gltf("a.glb", one_mesh(R"({"attributes":{"POSITION":0},"indices":1,"mode":5})",
                                  kSquarePoints + order,
                                  {kSquare, bytes_of(std::uint8_t{0}, 1, 2, 2, 1, 3)}));
  ASSERT_TRUE(strip) << strip.error().message;
  EXPECT_EQ(strip.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 3, 1}}));
}

TEST(ReadGltf, ReplacesWhatASparseListNames) {
  const std::string points =
      R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)"
      R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}})";
  const std::string primitive = R"({"attributes":{"POSITION":0}})";
  const std::string five = bytes_of(0.0F, 0.005F, 0);
  const auto read =
      read_gltf("a.glb", one_mesh(primitive, points, {kSquare, bytes_of(std::uint8_t{2}), five}));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read.value().positions[2].z, 5.0, 1e-6);
  EXPECT_NEAR(read.value().positions[1].x, 1.0, 1e-6);
  EXPECT_THAT(
      gltf_error("a.glb", one_mesh(primitive, points, {kSquare, bytes_of(std::uint8_t{3}), five})),
      HasSubstr("accessor 0 has a sparse list that names value 3 out of order or beyond its 3"));
  EXPECT_THAT(gltf_error("a.glb", one_mesh(primitive, points,
                                           {kSquare, bytes_of(std::uint8_t{2}), bytes_of(0.0F)})),
              HasSubstr("accessor 0 has a sparse list that goes beyond its data"));
}

TEST(ReadGltf, BelievesNoCountThatNoBytesStandFor) {
  const std::string points =
      R"({"componentType":5126,"count":90000000,"type":"VEC3","sparse":{"count":1,)"
      R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}})";
  EXPECT_THAT(gltf_error("a.glb", one_mesh(R"({"attributes":{"POSITION":0}})", points,
                                           {kSquare, bytes_of(std::uint8_t{2})})),
              HasSubstr("positions are not floats or short integers of their own"));
}

TEST(ReadGltf, TakesQuantizedPositions) {
  const std::string points =
      R"({"bufferView":0,"componentType":5122,"count":3,"type":"VEC3","normalized":true})";
  const std::string shorts = bytes_of(std::int16_t{0}, 0, 0, 32767, 0, 0, 0, -32768, 0);
  const auto read =
      read_gltf("a.glb", one_mesh(R"({"attributes":{"POSITION":0}})", points, {shorts},
                                  R"(,"extensionsRequired":["KHR_mesh_quantization"])"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(corners(read.value()), (std::vector<Vec3>{{0, 0, 0}, {1000, 0, 0}, {0, 0, -1000}}));
}

/// The square follows joint 1 by half and joint 2 by half; the node that has the skin is elsewhere.
TEST(ReadGltf, MovesASkinAsItsJointsStandAtRest) {
  const std::string skin = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":3}])";
  const std::string nodes =
      R"([{"mesh":0,"skin":0,"translation":[9,9,9],"children":[1]},)"
      R"({"translation":[-9,-9,-9],"children":[2]},{"translation":[0,0.004,0]}])";
  const std::string accessors =
      kSquarePoints + R"(,{"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"})" +
      R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"})" +
      R"(,{"bufferView":3,"componentType":5126,"count":2,"type":"MAT4"})";
  std::string joints;
  std::string weights;
  for (int v = 0; v < 4; ++v) {
    joints += bytes_of(std::uint8_t{0}, 1, 0, 0);
    weights += bytes_of(std::uint8_t{100}, 100, 0, 0);
  }
  const std::string identity = bytes_of(1.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  const std::string raised = bytes_of(1.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.002F, 0, 1);
  const std::string primitive =
      R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"mode":5})";
  const auto read = read_gltf(
      "a.glb",
      one_mesh(primitive, accessors, {kSquare, joints, weights, identity + raised}, skin, nodes));
  ASSERT_TRUE(read) << read.error().message;
  // Joint 1 stands at 0 and joint 2 at 4 + 2 mm: half of both is 3 mm up.
  EXPECT_NEAR(length(read.value().positions[0] - Vec3{0, 0, 3}), 0.0, 1e-5);
  EXPECT_NEAR(length(read.value().positions[3] - Vec3{1, 0, 4}), 0.0, 1e-5);
  joints[1] = 2;
  EXPECT_THAT(
      gltf_error("a.glb", one_mesh(primitive, accessors,
                                   {kSquare, joints, weights, identity + raised}, skin, nodes)),
      HasSubstr("vertex 0 of a mesh follows joint 2 of only 2"));
  EXPECT_THAT(gltf_error("a.glb", one_mesh(primitive, accessors,
                                           {kSquare, joints, weights, identity + raised},
                                           R"(,"skins":[{"joints":[1,7]}])", nodes)),
              HasSubstr("skin 0 has the joint 7, which is not in the scene"));
}

TEST(ReadGltf, MorphsByTheWeightsOfTheFile) {
  const std::string accessors =
      kSquarePoints + R"(,{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"})";
  const std::string moves = bytes_of(0.0F, 0, 0, 0, 0, 0, 0, 0, 0, 0.004F, 0, 0);
  const std::string primitive =
      R"({"attributes":{"POSITION":0},"mode":5,"targets":[{"POSITION":1}]}],"weights":[0.5)";
  const auto of_mesh = read_gltf("a.glb", one_mesh(primitive, accessors, {kSquare, moves}));
  ASSERT_TRUE(of_mesh) << of_mesh.error().message;
  EXPECT_NEAR(of_mesh.value().positions[3].x, 3.0, 1e-6);
  const auto of_node = read_gltf("a.glb", one_mesh(primitive, accessors, {kSquare, moves}, "",
                                                   R"([{"mesh":0,"weights":[0]}])"));
  ASSERT_TRUE(of_node) << of_node.error().message;
  EXPECT_NEAR(of_node.value().positions[3].x, 1.0, 1e-6);
}

std::string gltf_text(const std::string& uri, const std::string& more = "") {
  return "{" + kAsset + R"(,"nodes":[{"children":[1]},{"mesh":0}],"meshes":[{"primitives":[)" +
         R"({"attributes":{"POSITION":0},"mode":5}]}],"buffers":[{"byteLength":48,"uri":")" + uri +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":48}],"accessors":[)" + kSquarePoints + "]" +
         more + "}";
}

TEST(ReadGltf, ReadsTextWithBuffersInItAndBesideIt) {
  const auto inside =
      read_gltf("a.gltf", gltf_text("data:application/octet-stream;base64," + base64(kSquare)));
  ASSERT_TRUE(inside) << inside.error().message;
  EXPECT_EQ(inside.value().triangles.size(), 2U);
  const ScratchFolder folder;
  fill(folder / "a.GLTF", gltf_text("a%20b.bin"));
  fill(folder / "a b.bin", kSquare);
  const auto beside = read_mesh(folder / "a.GLTF");
  ASSERT_TRUE(beside) << beside.error().message;
  EXPECT_EQ(beside.value().positions, inside.value().positions);
}

TEST(ReadGltf, RefusesBuffersThatAreElsewhere) {
  for (const char* uri : {"../a.bin", "/dev/zero", "http://a/b.bin", "%2e%2e/a.bin", ""}) {
    EXPECT_THAT(gltf_error("a.gltf", gltf_text(uri)),
                AllOf(HasSubstr("buffer 0 is in another file"), HasSubstr("not in its folder")))
        << uri;
  }
  EXPECT_THAT(
      gltf_error("a.gltf", gltf_text("no.bin")),
      AllOf(HasSubstr("a.gltf: buffer 0 is in another file: cannot read"), HasSubstr("no.bin")));
  EXPECT_THAT(gltf_error("a.gltf", gltf_text("data:;base64,A*==")), HasSubstr("base64"));
  EXPECT_THAT(gltf_error("a.gltf", gltf_text("data:;base64,AAAA")),
              HasSubstr("goes beyond its data"));
}

TEST(ReadGltf, RefusesCompressionAndOtherExtensionsByName) {
  const auto required = [](const std::string& name) {
    return gltf_text("data:;base64," + base64(kSquare),
                     R"(,"extensionsRequired":[")" + name + "\"]");
  };
  for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    EXPECT_THAT(gltf_error("a.gltf", required(name)),
                HasSubstr("compressed by " + name + ", which is not read here; export without"));
  }
  EXPECT_THAT(gltf_error("a.gltf", required("EXT_mesh_gpu_instancing")),
              HasSubstr("requires the extension 'EXT_mesh_gpu_instancing'"));
  EXPECT_TRUE(read_gltf("a.gltf", required("KHR_materials_unlit")));
}

/// What is compressed need not be required: without a copy that is plain, data are missing.
TEST(ReadGltf, NamesTheCompressionWhereDataAreMissing) {
  EXPECT_THAT(
      gltf_error("a.glb", glb_file("{" + kAsset +
                                       R"(,"extensionsUsed":["KHR_draco_mesh_compression"],)"
                                       R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
                                       R"({"attributes":{"POSITION":0}}]}],"accessors":[)"
                                       R"({"componentType":5126,"count":3,"type":"VEC3"}]})",
                                   "")),
      HasSubstr("compressed by KHR_draco_mesh_compression"));
}

TEST(ReadGltf, RefusesOtherVersionsByName) {
  EXPECT_THAT(gltf_error("a.gltf", R"({"asset":{"version":"1.0"},"meshes":{}})"),
              HasSubstr("a.gltf: glTF version 1.0; must be 2.0"));
  EXPECT_THAT(gltf_error("a.gltf", R"({"meshes":{"m":{}}})"), HasSubstr("glTF version 1.0"));
  EXPECT_THAT(gltf_error("a.gltf", R"({"asset":{"version":1.1}})"), HasSubstr("glTF version 1.1"));
  EXPECT_THAT(gltf_error("a.gltf", R"({"asset":{"version":"2.0","minVersion":"2.1"}})"),
              HasSubstr("glTF version \"2.1\""));
  EXPECT_THAT(gltf_error("a.gltf", R"({"asset":{"version":"3.0"}})"), HasSubstr("version \"3.0\""));
  std::string glb = one_mesh(R"({"attributes":{"POSITION":0}})", kSquarePoints, {kSquare});
  glb[4] = 1;
  EXPECT_THAT(gltf_error("a.glb", glb), HasSubstr("byte 4: glTF version 1; must be 2.0"));
}

TEST(ReadGltf, NamesNumbersThatAreNone) {
  EXPECT_THAT(
      gltf_error("a.glb", one_mesh(R"({"attributes":{"POSITION":-1}})", kSquarePoints, {kSquare})),
      HasSubstr("must be a whole number of 0 or more, but is -1"));
  EXPECT_THAT(gltf_error("a.glb", one_mesh(R"({"attributes":{"POSITION":1e300}})", kSquarePoints,
                                           {kSquare})),
              HasSubstr("must be a whole number of 0 or more"));
  EXPECT_TRUE(read_gltf("a.glb", one_mesh(R"({"attributes":{"POSITION":0.0},"mode":5.0})",
                                          kSquarePoints, {kSquare})));
}

/// Each node would work through all of them again.
TEST(ReadGltf, CountsMorphTargetsThatAreLookedAt) {
  std::string targets;
  std::string weights;
  std::string nodes;
  std::string places;
  for (int n = 0; n < 11'000; ++n) {
    const char* comma = n > 0 ? "," : "";
    targets += std::string(comma) + "{}";
    weights += std::string(comma) + "1";
    nodes += std::string(comma) + R"({"mesh":0})";
    places += comma + std::to_string(n);
  }
  const std::string json = "{" + kAsset + R"(,"scenes":[{"nodes":[)" + places + R"(]}],"nodes":[)" +
                           nodes + R"(],"meshes":[{"weights":[)" + weights +
                           R"(],"primitives":[{"attributes":{"POSITION":0},)" + R"("targets":[)" +
                           targets + R"(]}]}],"bufferViews":[{"byteLength":48}],"accessors":[)" +
                           kSquarePoints + "]}";
  EXPECT_THAT(gltf_error("a.glb", glb_file(json, kSquare)),
              HasSubstr("more than 100000000 vertices"));
}

}  // namespace
}  // namespace argil::io
