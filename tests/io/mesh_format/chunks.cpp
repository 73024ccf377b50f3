// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_format/chunks.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/io/mesh_file.h"
#include "argil/mesh/rounding.h"

#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

/// More than the pieces that are made at once, three times over, and a part of one.
constexpr std::size_t kManyItems = 50 * kItemsInPiece + 77;

/// Remembers how often it made something.
struct CountingMaker {
  std::vector<std::size_t> made;
  int uses = 0;
};

TEST(MakeInOrder, UsesEveryItemOnceInOrder) {
  std::size_t next = 0;
  int most_uses = 0;
  const auto make = [](const ItemRange& range, CountingMaker& maker) {
    maker.made.clear();
    for (std::size_t i = range.begin; i < range.end; ++i) maker.made.push_back(i);
    ++maker.uses;
  };
  const auto use = [&](const ItemRange& range, const CountingMaker& maker) {
    EXPECT_EQ(range.begin, next);
    EXPECT_EQ(maker.made.size(), range.end - range.begin);
    EXPECT_LE(range.end - range.begin, kItemsInPiece);
    for (const std::size_t i : maker.made) EXPECT_EQ(i, next++);
    most_uses = std::max(most_uses, maker.uses);
    return true;
  };
  EXPECT_TRUE(make_in_order<CountingMaker>(kManyItems, make, use));
  EXPECT_EQ(next, kManyItems);
  // The memory of one turn is that of the next.
  EXPECT_EQ(most_uses, 4);
}

TEST(MakeInOrder, EndsWithNothingAndWhereItIsTold) {
  const auto make = [](const ItemRange&, CountingMaker&) {};
  EXPECT_TRUE(make_in_order<CountingMaker>(0, make, [](const ItemRange&, const CountingMaker&) {
    ADD_FAILURE();
    return true;
  }));
  // In the second turn.
  std::size_t used = 0;
  const auto use = [&](const ItemRange& range, const CountingMaker&) {
    used = range.end;
    return range.end < 20 * kItemsInPiece;
  };
  EXPECT_FALSE(make_in_order<CountingMaker>(kManyItems, make, use));
  EXPECT_EQ(used, 20 * kItemsInPiece);
}

/// Of 160 801 vertices and 320 000 triangles: vertices take two turns of pieces, triangles three.
TriangleMesh long_mesh() {
  const TriangleMesh mesh = mesh::rounded_to_float(test::torus_mesh(20.0, 7.0, 800, 200));
  EXPECT_GT(mesh.positions.size(), 16 * kItemsInPiece);
  EXPECT_GT(mesh.triangles.size(), 32 * kItemsInPiece);
  return mesh;
}

/// The corners of all triangles in their order, as a reader gives them.
std::vector<Vec3> all_corners(const TriangleMesh& mesh) {
  std::vector<Vec3> corners;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) corners.push_back(mesh.positions[v]);
  }
  return corners;
}

TEST(WriteMeshGolden, OfManyPiecesComesBackAndIsTheSameForAnyNumberOfThreads) {
  const test::ScratchFolder folder;
  const TriangleMesh mesh = long_mesh();
  for (const char* ending : {".3mf", ".stl", ".obj", ".ply", ".glb"}) {
    SCOPED_TRACE(ending);
    std::string first;
    for (const std::size_t threads : {1U, 2U, 7U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const std::filesystem::path file = folder / (std::string("a") + ending);
      ASSERT_TRUE(write_mesh(file, mesh));
      const std::string bytes = test::content_of(file);
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << threads;
    }
    const Result<TriangleMesh> back = read_mesh(folder / (std::string("a") + ending));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(all_corners(mesh::rounded_to_float(back.value())) == all_corners(mesh));
  }
}

TEST(WriteMesh, OfManyPiecesStopsWhenAskedAndLeavesTheOldFile) {
  const test::ScratchFolder folder;
  const TriangleMesh mesh = long_mesh();
  for (const std::string ending : {".3mf", ".stl", ".obj", ".ply", ".glb"}) {
    SCOPED_TRACE(ending);
    const std::filesystem::path file = folder / ("a" + ending);
    test::fill(file, "old");
    int asked = 0;
    // In the second turn of triangles; an STL has no vertices.
    const double enough = ending == ".stl" ? 0.5 : 0.7;
    const auto listen = [&](std::string_view, double fraction) {
      ++asked;
      return fraction < enough;
    };
    const Result<void> written = write_mesh(file, mesh, {}, listen);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::interrupted);
    EXPECT_GT(asked, 16);
    EXPECT_EQ(test::content_of(file), "old");
  }
}

}  // namespace
}  // namespace argil::io
