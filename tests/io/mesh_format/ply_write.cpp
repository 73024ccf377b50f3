// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using test::box_mesh;
using testing::HasSubstr;

/// The colors are read by others; here the bytes: 15 for a vertex.
TEST(MeshFileColors, StandBesideTheVerticesOfAPly) {
  const test::ScratchFolder folder;
  const TriangleMesh box = box_mesh({1, 2, 3});
  WriteOptions options;
  options.colors.assign(box.positions.size(), {10, 20, 30});
  options.colors[2] = {200, 100, 50};
  ASSERT_TRUE(write_mesh(folder / "box.ply", box, options));
  const std::string bytes = test::content_of(folder / "box.ply");
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  EXPECT_THAT(bytes.substr(0, body), HasSubstr("property uchar blue\nelement face"));
  const std::size_t third = body + 2 * 15 + 12;
  EXPECT_EQ(bytes.substr(third, 3), std::string("\xc8\x64\x32"));
  EXPECT_EQ(read_mesh(folder / "box.ply").value().positions, box.positions);
  options.colors.pop_back();
  const auto refused = write_mesh(folder / "box.ply", box, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("7 colors for 8 vertices"));
  EXPECT_EQ(test::content_of(folder / "box.ply"), bytes);
}

}  // namespace
}  // namespace argil::io
