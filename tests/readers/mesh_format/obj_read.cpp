// SPDX-License-Identifier: GPL-3.0-or-later
// Texts as other programs and systems write them.
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_format/mesh_read.h"
#include "support/bytes/mesh_bytes.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

Result<TriangleMesh> parsed_obj(const std::string& text) {
  return parse_obj(std::as_bytes(std::span(text)), "a.obj");
}

const std::string kObjText = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ReadObjText, MayBeginWithTheMarkOfUtf8) {
  const auto mesh = parsed_obj("\xEF\xBB\xBF" + kObjText);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().positions.size(), 3U);
}

TEST(ReadObjText, MayBeUtf16WithItsMark) {
  for (const bool higher_first : {true, false}) {
    std::string text = test::utf16(kObjText + "# ?\n", higher_first);
    // A letter beyond ASCII.
    const std::size_t mark = text.find('?');
    text[higher_first ? mark - 1 : mark + 1] = '\x26';
    const auto mesh = parsed_obj(text);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh.value().triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_THAT(parsed_obj(test::utf16("v 0 0 x\n", higher_first)).error().message,
                HasSubstr("a.obj:1: 'x' is not a number"));
    // Cut in the middle of the last line end.
    EXPECT_FALSE(parsed_obj(test::utf16(kObjText, higher_first).substr(0, 65)));
  }
}

TEST(ReadObjText, MayEndLinesAsOldMacsDo) {
  std::string text = "# a\n" + kObjText;
  for (char& c : text) c = c == '\n' ? '\r' : c;
  const auto mesh = parsed_obj(text);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().positions.size(), 3U);
  EXPECT_THAT(parsed_obj("# a\rv 0 0 x\r").error().message, HasSubstr("a.obj:2: 'x'"));
}

TEST(ReadObjText, MayHaveAStrayCarriageReturn) {
  const auto mesh = parsed_obj("# a\rb\n" + kObjText);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().positions.size(), 3U);
}

TEST(ReadObjText, MayCallFacesByTheirOlderName) {
  EXPECT_EQ(parsed_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n").value().triangles.size(), 1U);
}

TEST(ReadStlText, MayBeUtf16WithItsMark) {
  const std::string text = test::utf16(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid a\n",
      false);
  const auto mesh = parse_stl(std::as_bytes(std::span(text)), "a.stl");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles.size(), 1U);
}

}  // namespace
}  // namespace argil::io
