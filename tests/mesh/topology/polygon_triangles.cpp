// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons in whose order, or along whose edges, a triangulation could take as many steps as pairs
// of corners. Nothing is timed: what takes more than kQuestionsPerCorner has no triangles.
#include "argil/mesh/polygon_triangles.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_format/face_collector.h"
#include "support/effort.h"

namespace argil::mesh {
namespace {

double area_of_triangles(const std::vector<Vec3>& corners, const std::vector<Triangle>& triangles) {
  double twice = 0.0;
  for (const auto& [a, b, c] : triangles) {
    twice += cross(corners[b] - corners[a], corners[c] - corners[a]).z;
  }
  return 0.5 * twice;
}

double area_of_corners(const std::vector<Vec3>& corners) {
  double twice = 0.0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    twice += cross(corners[i - 1] - corners[0], corners[i] - corners[0]).z;
  }
  return 0.5 * twice;
}

/// A simple polygon of n corners has n - 2 triangles, which cover it once.
void expect_covered_once(const std::vector<Vec3>& corners) {
  const std::vector<Triangle> triangles = triangulated(corners);
  EXPECT_EQ(triangles.size(), corners.size() - 2);
  const double area = area_of_corners(corners);
  EXPECT_NEAR(area_of_triangles(corners, triangles), area, 1e-9 * std::abs(area));
}

/// All triangles of the first corners are replaced by each next one.
TEST(PolygonTriangles, OfAParabolaAtTheMostCorners) {
  std::vector<Vec3> corners;
  for (std::size_t i = io::FaceCollector::kMostCorners; i > 0; --i) {
    const auto x = static_cast<double>(i);
    corners.push_back({x / 128.0, x * x / 16384.0, 0.0});
  }
  expect_covered_once(corners);
}

/// Teeth so long and askew that each edge passes half of the others' corners.
TEST(PolygonTriangles, OfABundleOfEdges) {
  const std::size_t teeth =
      test::effort<std::size_t>(10'000, io::FaceCollector::kMostCorners / 2 - 2);
  const auto shift = 0.5 * static_cast<double>(teeth);
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < teeth; ++i) {
    const auto x = static_cast<double>(i);
    corners.push_back({x, 0.0, 0.0});
    corners.push_back({x + shift, shift, 0.0});
  }
  const double right = 2.0 * static_cast<double>(teeth);
  corners.push_back({right, shift, 0.0});
  corners.push_back({right, -1.0, 0.0});
  corners.push_back({-1.0, -1.0, 0.0});
  expect_covered_once(corners);
}

/// There and back from one corner, which stands in the polygon as often as all the others.
TEST(PolygonTriangles, OfSpikesAroundOneCorner) {
  const std::size_t spikes =
      test::effort<std::size_t>(10'000, io::FaceCollector::kMostCorners / 2 - 3);
  const auto right = static_cast<double>(spikes);
  std::vector<Vec3> corners{
      {-1.0, -right, 0.0}, {right, -right, 0.0}, {right, right, 0.0}, {-1.0, right, 0.0}};
  const Vec3 hub{-1.0, 0.0, 0.0};
  for (std::size_t i = 0; i < spikes; ++i) {
    const auto y = static_cast<double>(i);
    corners.push_back(hub);
    corners.push_back({0.5 * right, 0.5 * y - 0.25 * right, 0.0});
  }
  corners.push_back(hub);
  const std::vector<Triangle> triangles = triangulated(corners);
  ASSERT_FALSE(triangles.empty());
  const double area = 2.0 * right * (right + 1.0);
  EXPECT_NEAR(area_of_triangles(corners, triangles), area, 1e-9 * area);
}

/// Each edge passes through the corners between its ends: as many steps as pairs, whoever counts.
TEST(PolygonTriangles, GivesUpWhereEachEdgePassesAllCorners) {
  constexpr std::size_t kCorners = 20'000;
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < kCorners / 2; ++i) {
    corners.push_back({static_cast<double>(i), 0.0, 0.0});
    corners.push_back({static_cast<double>(kCorners - i), 0.0, 0.0});
  }
  corners.push_back({0.0, 1.0, 0.0});
  EXPECT_TRUE(triangulated(corners).empty());
}

/// Where two corners share a position, the triangles name the first of them.
TEST(PolygonTriangles, NameTheFirstCornerOfAPlace) {
  const std::vector<Vec3> pentagon{{0, 0, 0}, {4, 0, 0}, {5, 3, 0}, {2, 5, 0}, {-1, 2, 0}};
  std::vector<Vec3> corners;
  for (int turn = 0; turn < 3; ++turn) {
    corners.insert(corners.end(), pentagon.begin(), pentagon.end());
  }
  const std::vector<Triangle> triangles = triangulated(corners);
  ASSERT_EQ(triangles.size(), 3U);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) EXPECT_LT(corner, 5U);
  }
}

}  // namespace
}  // namespace argil::mesh
