// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that cross, touch and lie on one another: what is left bounds their union, exactly.
#include "repair/resolve_crossings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/core/winding_number.h"
#include "argil/mesh/check.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/repair.h"
#include "argil/mesh/rounding.h"

#include "support/effort.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

MendedMesh mended(const TriangleMesh& mesh) {
  auto result = mend_mesh(mesh);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_TRUE(result.value().report.verdict.printable);
  return std::move(result).value();
}

TriangleMesh box_between(const Vec3& low, const Vec3& high) {
  return test::box_mesh(high - low, (low + high) / 2.0);
}

TEST(ResolveCrossings, BoxesWithPartOfAFaceInCommonAreOne) {
  const TriangleMesh two =
      test::joined(box_between({0, 0, 0}, {10, 10, 10}), box_between({10, 2, 3}, {20, 8, 15}));
  const MendedMesh result = mended(two);
  EXPECT_EQ(result.report.verdict.components, 1);
  EXPECT_EQ(result.report.verdict.volume_mm3, 1000.0 + 10.0 * 6.0 * 12.0);
  EXPECT_LE(result.mesh.triangles.size(), 100U);
  EXPECT_EQ(result.report.united_parts, 1);
}

/// The same face twice, cut along its other diagonal.
TEST(ResolveCrossings, AFaceInCommonMayBeCutInTwoWays) {
  TriangleMesh right = box_between({10, 0, 0}, {20, 10, 10});
  const Vec3 middle{15, 5, 5};
  for (Vec3& p : right.positions) p.y = 2.0 * middle.y - p.y;  // mirrored: the other diagonals
  for (Triangle& t : right.triangles) std::swap(t[1], t[2]);
  const MendedMesh result = mended(test::joined(box_between({0, 0, 0}, {10, 10, 10}), right));
  EXPECT_EQ(result.report.verdict.components, 1);
  EXPECT_EQ(result.report.verdict.volume_mm3, 2000.0);
  EXPECT_LE(result.mesh.triangles.size(), 100U);
}

TEST(ResolveCrossings, KeepsCavitiesAndWhatLiesInThem) {
  const TriangleMesh shell = test::joined(box_between({0, 0, 0}, {20, 20, 20}),
                                          test::inside_out(box_between({4, 4, 4}, {16, 16, 16})));
  const TriangleMesh all = test::joined(test::joined(shell, box_between({8, 8, 8}, {10, 10, 10})),
                                        box_between({18, 5, 5}, {25, 9, 9}));
  const MendedMesh result = mended(all);
  EXPECT_EQ(result.report.verdict.components, 3);
  EXPECT_EQ(result.report.verdict.cavities, 1);
  EXPECT_EQ(result.report.verdict.volume_mm3, 8000.0 - 1728.0 + 8.0 + 5.0 * 16.0);
}

TEST(ResolveCrossings, DropsWhatLiesWithin) {
  const TriangleMesh outer = box_between({0, 0, 0}, {20, 20, 20});
  const MendedMesh result = mended(test::joined(outer, box_between({4, 4, 4}, {9, 9, 9})));
  EXPECT_EQ(result.mesh.triangles.size(), 12U);
  EXPECT_EQ(result.report.verdict.volume_mm3, 8000.0);
  EXPECT_EQ(result.report.united_parts, 1);
}

/// Two cavities with a wall of no thickness between them, whose sides are cut along other
/// diagonals.
TEST(ResolveCrossings, CavitiesWithAFaceInCommonStayHollow) {
  TriangleMesh right = box_between({5, 2, 2}, {8, 8, 8});
  for (Vec3& p : right.positions) p.y = 10.0 - p.y;  // mirrored, and so inside out
  const TriangleMesh cavities =
      test::joined(test::inside_out(box_between({2, 2, 2}, {5, 8, 8})), right);
  const MendedMesh result = mended(test::joined(box_between({0, 0, 0}, {10, 10, 10}), cavities));
  EXPECT_EQ(result.report.verdict.cavities, 1);
  EXPECT_EQ(result.report.verdict.volume_mm3, 1000.0 - 6.0 * 6.0 * 6.0);
}

/// Rounding makes them cross anew, so that there are several rounds.
TEST(ResolveCrossings, ProgressNeverGoesBack) {
  double last = 0.0;
  const Progress tell = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  TriangleMesh turned = test::ball_mesh(10.0, 3);
  for (Vec3& p : turned.positions) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
  ASSERT_TRUE(mend_mesh(test::joined(test::ball_mesh(10.0, 3), turned), {}, tell));
  EXPECT_GT(last, 0.6);  // where the second round begins
}

/// In whole millimetres, so that faces lie on one another, edges in faces and corners on edges, and
/// the volume of the union is a number of cubes.
TEST(ResolveCrossings, UnionOfRandomBoxesHasTheVolumeOfItsCubes) {
  constexpr int kSide = 12;
  std::mt19937 random(7);
  const int rounds = test::effort(40, 400);
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    std::vector<bool> is_full(kSide * kSide * kSide, false);
    TriangleMesh boxes;
    const int count = std::uniform_int_distribution(2, 6)(random);
    for (int n = 0; n < count; ++n) {
      Vec3 low;
      Vec3 high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::uniform_int_distribution(0, kSide - 1)(random);
        high[k] = std::uniform_int_distribution(static_cast<int>(low[k]) + 1, kSide)(random);
      }
      boxes = test::joined(boxes, box_between(low, high));
      for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const Vec3 at{0.5 + i % kSide, 0.5 + i / kSide % kSide, 0.5 + i / kSide / kSide};
        const bool is_in = at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y &&
                           at.z > low.z && at.z < high.z;
        if (is_in) is_full[static_cast<std::size_t>(i)] = true;
      }
    }
    const double cubes = static_cast<double>(std::count(is_full.begin(), is_full.end(), true));
    const MendedMesh result = mended(boxes);
    // Where boxes touch along an edge alone, they were drawn apart by a micrometre.
    const double drawn = result.report.parted_vertices > 0 ? 0.1 : 1e-9;
    EXPECT_NEAR(result.report.verdict.volume_mm3, cubes, drawn);
  }
}

/// Turned, nothing lies on anything exactly: everything new is rounded.
TEST(ResolveCrossings, UnionOfTurnedBoxesIsWithinRounding) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  const int rounds = test::effort(20, 200);
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    TriangleMesh boxes;
    std::vector<WindingNumber> given;
    for (int n = 0; n < 5; ++n) {
      const Vec3 x = normalized(Vec3{gauss(random), gauss(random), gauss(random)});
      const Vec3 y = normalized(cross(x, Vec3{gauss(random), gauss(random), gauss(random)}));
      const Vec3 z = cross(x, y);
      TriangleMesh box = test::box_mesh({12, 9, 7});
      const Vec3 at{gauss(random), gauss(random), gauss(random)};
      for (Vec3& p : box.positions) p = 3.0 * at + p.x * x + p.y * y + p.z * z;
      given.emplace_back(box.positions, box.triangles);
      boxes = test::joined(boxes, box);
    }
    const MendedMesh result = mended(boxes);
    const WindingNumber made(result.mesh.positions, result.mesh.triangles);
    for (int n = 0; n < 200; ++n) {
      const Vec3 at = 6.0 * Vec3{gauss(random), gauss(random), gauss(random)};
      const bool is_in_one = std::any_of(
          given.begin(), given.end(), [&](const WindingNumber& box) { return box.at(at) > 0.5; });
      EXPECT_NEAR(made.at(at), is_in_one ? 1.0 : 0.0, 0.2);
    }
  }
}

TEST(ResolveCrossings, OpensATubeThroughItself) {
  const TriangleMesh knot = test::self_crossing_mesh();
  ASSERT_GT(check_mesh(knot).self_intersections, 100);
  const MendedMesh result = mended(knot);
  EXPECT_EQ(result.report.united_parts, 0);
  EXPECT_LT(result.report.verdict.volume_mm3, signed_volume(knot));
  const WindingNumber given(knot.positions, knot.triangles);
  const WindingNumber made(result.mesh.positions, result.mesh.triangles);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-12.0, 12.0);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 at{across(random), across(random), 0.4 * across(random)};
    EXPECT_EQ(made.at(at) > 0.5, given.at(at) > 0.5);
  }
}

TEST(ResolveCrossings, SameBitsEveryTime) {
  const TriangleMesh two =
      test::joined(test::ball_mesh(10.0, 4), test::ball_mesh(6.0, 4, {9, 1, 2}));
  const MendedMesh once = mended(two);
  const MendedMesh again = mended(two);
  EXPECT_EQ(once.mesh.positions, again.mesh.positions);
  EXPECT_EQ(once.mesh.triangles, again.mesh.triangles);
}

}  // namespace
}  // namespace argil::mesh
