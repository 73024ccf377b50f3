// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/seams.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace argil::mesh {
namespace {

Vec3 on_circle(double radius, double turn) {
  return {radius * std::cos(turn), radius * std::sin(turn), 0.0};
}

/// A fan of loose triangles, whose corners in the middle nearly meet; the others do not.
TriangleMesh loose_fan(std::uint32_t count) {
  TriangleMesh fan;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / count;
    fan.positions.push_back(on_circle(1e-6, 17.0 * turn));
    fan.positions.push_back(on_circle(100.0, turn));
    fan.positions.push_back(on_circle(100.0, turn + std::numbers::pi / count));
    fan.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return fan;
}

std::set<std::uint32_t> middle_corners(const TriangleMesh& fan) {
  std::set<std::uint32_t> corners;
  for (const Triangle& t : fan.triangles) corners.insert(t[0]);
  return corners;
}

/// Compared each with each they would be 10^10 pairs.
TEST(JoinRims, JoinsACrowdOfVerticesNearEachOther) {
  constexpr std::uint32_t kCount = 100'000;
  TriangleMesh fan = loose_fan(kCount);
  EXPECT_EQ(join_rims(fan, 1e-4), kCount - 1);
  EXPECT_EQ(fan.triangles.size(), kCount);
  EXPECT_EQ(middle_corners(fan), std::set<std::uint32_t>{0});
}

/// Also those of a crowd that is wider than the distance, and none beyond it.
TEST(JoinRims, JoinsAlongACrowdAndNotBeyondIt) {
  TriangleMesh fan = loose_fan(1000);
  EXPECT_EQ(join_rims(fan, 1e-7), 999) << "neighbours on the circle in the middle are 6e-9 apart";
  TriangleMesh apart = loose_fan(1000);
  for (std::size_t v = 0; v < apart.positions.size(); v += 3) {
    if (apart.positions[v].x > 0.0) apart.positions[v].x += 1e-3;
  }
  EXPECT_EQ(join_rims(apart, 1e-4), 998);
  EXPECT_EQ(middle_corners(apart).size(), 2U);
}

/// The diagonal of a cube against an edge that was split at many points: in its box lie all others.
TEST(SplitAtRims, SplitsALongEdgeThatLiesAskewAtAllVerticesOnIt) {
  constexpr std::uint32_t kPieces = 5000;
  constexpr double kSide = 100.0;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= kPieces; ++i) {
    const double at = kSide * i / kPieces;
    mesh.positions.push_back({at, at, at});
  }
  const auto other = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({kSide, 0.0, 0.0});
  for (std::uint32_t i = 0; i < kPieces; ++i) mesh.triangles.push_back({i, i + 1, other});
  mesh.positions.push_back({0.0, kSide, 0.0});
  mesh.triangles.push_back({kPieces, 0, other + 1});
  EXPECT_EQ(split_at_rims(mesh, 1e-6), 1);
  EXPECT_EQ(mesh.triangles.size(), 2 * kPieces);
  EXPECT_EQ(split_at_rims(mesh, 1e-6), 0);
}

/// Edges as long as the mesh, all askew, of which none lies on another.
TEST(SplitAtRims, LeavesASoupOfLongTriangles) {
  TriangleMesh soup;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const double t = 0.1 * i;
    soup.positions.push_back(on_circle(100.0, 1.7 * t) + Vec3{0.0, 0.0, std::fmod(t, 90.0)});
    soup.positions.push_back(on_circle(90.0, 2.9 * t) + Vec3{1.0, 0.0, std::fmod(3.1 * t, 80.0)});
    soup.positions.push_back(on_circle(80.0, 5.3 * t) + Vec3{0.0, 1.0, std::fmod(7.7 * t, 70.0)});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(split_at_rims(soup, 1e-6), 0);
  EXPECT_EQ(soup.triangles.size(), 5000U);
}

}  // namespace
}  // namespace argil::mesh
