// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/body_parts.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/mesh/compact.h"

#include "support/shapes.h"

namespace argil::io {
namespace {

using test::box_mesh;
using testing::ElementsAre;

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p += by;
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto base = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles) {
      all.triangles.push_back({base + a, base + b, base + c});
    }
  }
  return all;
}

Assembly of_one(TriangleMesh mesh) {
  return {{{"piece", Srgb{1, 2, 3}, std::move(mesh)}}, {{"", {{0, {}}}}}};
}

std::vector<double> volumes_of(const TriangleMesh& mesh) {
  std::vector<double> volumes;
  for (const AssemblyObject& object : split_into_bodies(of_one(mesh)).objects) {
    volumes.push_back(std::round(1e6 * signed_volume(object.mesh)) / 1e6);
  }
  return volumes;
}

TEST(BodyParts, AreShellsWithTheirCavities) {
  const TriangleMesh mesh =
      together({box_mesh({1, 1, 1}), box_mesh({10, 10, 10}), inside_out(box_mesh({4, 4, 4})),
                moved(box_mesh({3, 3, 3}), {20, 0, 0})});
  EXPECT_THAT(volumes_of(mesh), ElementsAre(1000.0 - 64.0, 27.0, 1.0));
  const Assembly parted = split_into_bodies(of_one(mesh));
  EXPECT_EQ(parted.objects[2].name, "piece 3");
  EXPECT_EQ(parted.objects[2].color, (Srgb{1, 2, 3}));
  ASSERT_EQ(parted.items.size(), 1U);
  EXPECT_EQ(parted.items[0].name, "piece");
  EXPECT_EQ(parted.items[0].placements.size(), 3U);
}

/// In a welded mesh, as of an STL, what touches shares vertices, edges and both sides of a face.
TEST(BodyParts, ArePartsAlsoWhereTheyTouchInWeldedVertices) {
  const TriangleMesh box = box_mesh({2, 2, 2});
  const Vec3 beside[] = {{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {0, 0, -2}, {0, -2, 2}};
  for (const Vec3& by : beside) {
    const TriangleMesh two = mesh::welded(together({box, moved(box, by)}));
    ASSERT_LT(two.positions.size(), 16U);
    EXPECT_THAT(volumes_of(two), ElementsAre(8.0, 8.0)) << by.x << by.y << by.z;
  }
  const TriangleMesh row = mesh::welded(
      together({box, moved(box, {2, 0, 0}), moved(box, {4, 0, 0}), moved(box, {2, 2, 0})}));
  EXPECT_THAT(volumes_of(row), ElementsAre(8.0, 8.0, 8.0, 8.0));
}

TEST(BodyParts, OfWhatIsOpenAreHeldTogetherByTheirRims) {
  // A box of six sides that share no vertex, and one that misses a side.
  TriangleMesh soup;
  const TriangleMesh box = box_mesh({4, 4, 4});
  for (const Triangle& t : box.triangles) {
    for (const std::uint32_t v : t) soup.positions.push_back(box.positions[v]);
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  TriangleMesh open = moved(box_mesh({2, 2, 2}), {20, 0, 0});
  open.triangles.resize(10);
  const Assembly parted = split_into_bodies(of_one(together({open, soup, open})));
  // The open box that is there twice is at one place, so that its rims meet.
  ASSERT_EQ(parted.objects.size(), 2U);
  EXPECT_EQ(parted.objects[0].mesh.triangles.size(), 12U);
  EXPECT_EQ(parted.objects[1].mesh.triangles.size(), 20U);
}

TEST(BodyParts, OutsideOfAShellAreBodiesWhicheverWayTheyFace) {
  const TriangleMesh corner = moved(inside_out(box_mesh({1, 1, 1})), {6, 6, 0});
  const TriangleMesh arms = together({box_mesh({20, 4, 4}), corner});
  EXPECT_THAT(volumes_of(arms), ElementsAre(320.0, -1.0));
}

TEST(BodyParts, ThatAreNamedStayAsTheyAre) {
  Assembly two = of_one(together({box_mesh({1, 1, 1}), moved(box_mesh({1, 1, 1}), {5, 0, 0})}));
  two.objects.push_back({"other", {}, box_mesh({1, 1, 1})});
  two.items.push_back({"", {{1, {}}}});
  EXPECT_EQ(split_into_bodies(two).objects.size(), 2U);
  const Assembly one = split_into_bodies(of_one(box_mesh({1, 1, 1})));
  ASSERT_EQ(one.objects.size(), 1U);
  EXPECT_EQ(one.objects[0].name, "piece");
}

TEST(BodyParts, StandWhereverTheWholeStood) {
  Assembly twice = of_one(together({box_mesh({1, 1, 1}), moved(box_mesh({1, 1, 1}), {5, 0, 0})}));
  twice.items.push_back({"again", {{0, {{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 9, 0}}}}}});
  const Box3 before = bounds(joined(twice));
  const Assembly parted = split_into_bodies(twice);
  EXPECT_EQ(placed_parts(parted).size(), 4U);
  EXPECT_EQ(parted.items[1].name, "again");
  EXPECT_EQ(bounds(joined(parted)).max, before.max);
}

}  // namespace
}  // namespace argil::io
