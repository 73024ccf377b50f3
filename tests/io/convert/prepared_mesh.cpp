// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/prepared_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/sculpture.h"

#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

/// A tetrahedron of 10 mm away from the origin; open without its last face.
std::filesystem::path tetrahedron(const test::ScratchFolder& folder, bool is_closed) {
  const auto file = folder / "m.obj";
  test::fill(file, std::string("v 5 5 5\nv 15 5 5\nv 5 15 5\nv 5 5 15\n"
                               "f 1 3 2\nf 1 2 4\nf 1 4 3\n") +
                       (is_closed ? "f 2 3 4\n" : ""));
  return file;
}

TEST(PreparedMesh, IsClosedAndAsLargeAsTheFileSays) {
  const test::ScratchFolder folder;
  const auto prepared = read_prepared_mesh(tetrahedron(folder, false));
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_EQ(prepared.value().closing.holes_closed, 1);
  EXPECT_TRUE(prepared.value().closing.closed);
  EXPECT_EQ(prepared.value().scale, 1.0);
  EXPECT_NEAR(prepared.value().largest_side_mm, 10.0, 1e-9);
}

TEST(PreparedMesh, IsScaledAboutTheOriginOfItsFile) {
  const test::ScratchFolder folder;
  const auto prepared = read_prepared_mesh(tetrahedron(folder, true), {40.0, true});
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_NEAR(prepared.value().scale, 4.0, 1e-12);
  EXPECT_NEAR(prepared.value().largest_side_mm, 40.0, 1e-9);
  EXPECT_NEAR(bounds(prepared.value().mesh).min.x, 20.0, 1e-9);
}

TEST(PreparedMesh, KeepsWhatWasGivenBesideWhatWasClosed) {
  const test::ScratchFolder folder;
  const auto prepared = read_prepared_mesh(tetrahedron(folder, false), {40.0, true});
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_EQ(prepared.value().given.triangles.size(), 3U);
  EXPECT_NEAR(bounds(prepared.value().given).min.x, 20.0, 1e-9);
  EXPECT_GT(prepared.value().mesh.triangles.size(), 3U);
}

TEST(PreparedMesh, SaysWhetherItsClayIsLikelyToFit) {
  const test::ScratchFolder folder;
  const auto prepared = read_prepared_mesh(tetrahedron(folder, true));
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_TRUE(is_likely_to_fit(prepared.value(), 0.5));
  for (const double voxel_mm : {1e-5, 1e-300, 5e-324}) {
    EXPECT_FALSE(is_likely_to_fit(prepared.value(), voxel_mm)) << voxel_mm;
  }
}

TEST(PreparedMesh, IsRefusedWhereNobodyMayCloseItOrItsSizeIsAMistake) {
  const test::ScratchFolder folder;
  const auto open = read_prepared_mesh(tetrahedron(folder, false), {0.0, false});
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(open.error().message, HasSubstr("3 open edges"));
  const auto large = read_prepared_mesh(tetrahedron(folder, true), {20'000.0, true});
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("is 20000 mm across; must be 0.01 to 10000 mm"));
  const auto closed = read_prepared_mesh(tetrahedron(folder, true), {0.0, false});
  ASSERT_TRUE(closed) << closed.error().message;
  EXPECT_EQ(closed.value().mesh.triangles.size(), 4U);
}

TEST(PieceNames, AreNumberedWithoutCuttingALetterInTwo) {
  std::string umlauts;
  for (int n = 0; n < 31; ++n) umlauts += "\u00e4";  // 62 bytes
  const auto names = io::piece_names({umlauts, umlauts, umlauts + "x", umlauts + "xyz"});
  ASSERT_EQ(names.size(), 4U);
  EXPECT_EQ(names[0], umlauts);
  EXPECT_EQ(names[1], umlauts.substr(0, 60) + " 2");
  EXPECT_EQ(names[2], umlauts + "x");
  EXPECT_EQ(names[3], umlauts.substr(0, 60) + " 3");
  for (const std::string& name : names) EXPECT_TRUE(validate_look({.name = name}).ok()) << name;
}

}  // namespace
}  // namespace argil::io
