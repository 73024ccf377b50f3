// SPDX-License-Identifier: GPL-3.0-or-later
// Strips of triangles, and headers as programs write them.
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Result<TriangleMesh> parsed_ply(const std::string& text) {
  return parse_ply(std::as_bytes(std::span(text)), "a.ply");
}

std::string vertices(const std::string& more_header) {
  return "ply\nformat ascii 1.0\n" + more_header +
         "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
}

const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";

std::string strips(const std::string& rows, int count = 1) {
  return vertices("") + "element tristrips " + std::to_string(count) +
         "\nproperty list int int vertex_indices\nend_header\n" + kPoints + rows;
}

TEST(ReadPlyStrips, TurnsEveryOtherTriangleOver) {
  const auto mesh = parsed_ply(strips("5 0 1 2 3 4\n"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
}

TEST(ReadPlyStrips, BeginAnewAtMinusOneAndInEachRow) {
  const auto mesh = parsed_ply(strips("9 -1 0 1 2 -1 -1 1 3 2\n3 2 3 4\n", 2));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(ReadPlyStrips, HopByTrianglesWithoutArea) {
  const auto mesh = parsed_ply(strips("7 0 1 2 2 2 3 4\n"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 3, 4}}));
}

TEST(ReadPlyStrips, NameTheVertexThatIsMissing) {
  EXPECT_THAT(parsed_ply(strips("3 0 1 5\n")).error().message,
              HasSubstr("a face names vertex 5 (from 0) of only 5"));
  EXPECT_THAT(parsed_ply(strips("3 0 1 -2\n")).error().message,
              HasSubstr("strips 1: a face names"));
  EXPECT_THAT(parsed_ply(strips("2 0 1\n")).error().message, HasSubstr("has no triangles"));
}

const std::string kFace =
    "element face 1\nproperty list uchar int vertex_index\nend_header\n" + kPoints + "3 0 1 2\n";

TEST(ReadPlyHeader, MayHoldLinesThatSayNothingKnown) {
  for (const std::string line : {"obj_info a\n", "comment\n", "Created by Blender3D 247 - \n", "\n",
                                 "  comment indented\n", "commentary\n"}) {
    EXPECT_TRUE(parsed_ply(vertices(line) + kFace)) << line;
  }
}

TEST(ReadPlyHeader, NamesAStrayLineWhereTheBodyDoesNotFit) {
  EXPECT_THAT(parsed_ply(vertices("elementt camera 1\n") + kFace + "7\n").error().message,
              AllOf(HasSubstr("more data than the header promises"),
                    HasSubstr("(header line 3, 'elementt'... is not known)")));
}

TEST(ReadPlyHeader, MayEndLinesAsOldMacsDoAndHaveBlanksBehindThem) {
  std::string mac = vertices("") + kFace;
  for (char& c : mac) c = c == '\n' ? '\r' : c;
  const auto mesh = parsed_ply(mac);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().positions.size(), 5U);
  std::string blanks = vertices("") + kFace;
  blanks.replace(0, 3, "ply ");
  blanks.replace(blanks.find("end_header"), 10, "end_header \t");
  EXPECT_TRUE(parsed_ply(blanks));
}

/// Its first byte is that of a newline, which belongs to the body.
TEST(ReadPlyHeader, EndsWithOneLineEndBeforeABinaryBody) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const std::string line :
         {"ply", "format binary_little_endian 1.0", "element tag 1", "property uchar a",
          "element vertex 3", "property uchar x", "property uchar y", "property uchar z",
          "element face 1", "property list uchar uchar vertex_indices", "end_header"}) {
      text += line + end;
    }
    text += std::string("\n\0\0\0\1\0\0\0\1\0\3\0\1\2", 14);
    const auto mesh = parsed_ply(text);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh.value().positions[1], (Vec3{1, 0, 0}));
  }
}

}  // namespace
}  // namespace argil::io
