// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of clay of known thickness, turned so that no axis helps.
#include "convert/field_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/operation.h"
#include "argil/engine/surface.h"
#include "argil/io/clay_check.h"

#include "support/effort.h"

namespace argil::io {
namespace {

constexpr double kWallVoxelMm = 0.25;
const Quat kTurn = normalized(Quat{0.9, 0.3, -0.5, 0.2});

double allowed(double thick) { return std::max(0.05 * thick, kWallVoxelMm); }

/// Turned clay of a formula that fits into a cube of `side_mm`.
Clay turned(const std::function<double(const Vec3&)>& distance, double side_mm) {
  const double reach = 0.5 * std::sqrt(3.0) * side_mm;
  Box3 box;
  box.include(Vec3{-reach, -reach, -reach});
  box.include(Vec3{reach, reach, reach});
  return Clay::from_distance([&](const Vec3& p) { return distance(rotate(conjugate(kTurn), p)); },
                             box, ClayOptions{.voxel_mm = kWallVoxelMm})
      .value();
}

struct Wall {
  Vec3 at;  ///< middle of the triangle before the turn
  double mm = 0.0;
};
std::vector<Wall> walls_of(const Clay& clay) {
  const TriangleMesh surface = extract_surface(clay);
  const Progress nobody;
  const auto thickness = field_thickness(surface, clay, 1.0, Pace(nobody, "walls"));
  std::vector<Wall> walls;
  for (std::size_t t = 0; t < thickness.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 middle = (surface.positions[a] + surface.positions[b] + surface.positions[c]) / 3.0;
    walls.push_back({rotate(conjugate(kTurn), middle), thickness[t].least_mm});
  }
  return walls;
}

double slab_distance(const Vec3& p, const Vec3& half) {
  const Vec3 q{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return length(out) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

TEST(FieldWall, OfSlabs) {
  for (const double thick : {0.4, 0.8, 2.0, 7.0}) {
    const Clay clay = turned(
        [=](const Vec3& p) {
          return slab_distance(p, {8.0, 9.0, 0.5 * thick});
        },
        20.0);
    double most = 0.0;
    int seen = 0;
    for (const Wall& wall : walls_of(clay)) {
      if (std::abs(wall.at.x) > 7.0 || std::abs(wall.at.y) > 8.0) continue;  // rims
      most = std::max(most, std::abs(wall.mm - thick));
      ++seen;
    }
    EXPECT_LT(most, 0.05 * thick) << thick;
    std::printf("slab %g mm: off by %.4f mm at most\n", thick, most);
    EXPECT_GT(seen, 5000);
  }
}

TEST(FieldWall, OfTubes) {
  for (const double thick : {0.8, 3.0}) {
    const Clay clay = turned(
        [=](const Vec3& p) {
          const double side = std::abs(std::hypot(p.x, p.y) - 7.0 + 0.5 * thick) - 0.5 * thick;
          return std::max(side, std::abs(p.z) - 8.0);
        },
        16.0);
    double most = 0.0;
    int seen = 0;
    for (const Wall& wall : walls_of(clay)) {
      if (std::abs(wall.at.z) > 7.0) continue;
      most = std::max(most, std::abs(wall.mm - thick));
      ++seen;
    }
    EXPECT_LT(most, allowed(thick)) << thick;
    std::printf("tube %g mm: off by %.4f mm at most\n", thick, most);
    EXPECT_GT(seen, 5000);
  }
}

/// On the lower side of a wedge the wall grows with the distance from its edge.
TEST(FieldWall, OfWedges) {
  for (const double degrees : {6.0, 12.0, 25.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Clay clay = turned(
        [=](const Vec3& p) {
          const double x = p.x + 9.0;  // from the edge
          const double above = (p.z + 3.0) * std::cos(angle) - x * std::sin(angle);
          return std::max({above, -(p.z + 3.0), std::abs(p.x) - 8.0, std::abs(p.y) - 5.0});
        },
        18.0);
    double most = 0.0;
    int seen = 0;
    for (const Wall& wall : walls_of(clay)) {
      const bool is_below = std::abs(wall.at.z + 3.0) < 0.05;
      if (!is_below || std::abs(wall.at.x) > 7.0 || std::abs(wall.at.y) > 4.0) continue;
      const double thick = (wall.at.x + 9.0) * std::tan(angle);
      most = std::max(most, std::abs(wall.mm - thick) / allowed(thick));
      ++seen;
    }
    EXPECT_LT(most, 1.0) << degrees;
    std::printf("wedge %g deg: off by %.3f of what is allowed at most\n", degrees, most);
    EXPECT_GT(seen, 1000);
  }
}

TEST(FieldWall, IsWhatHollowingWasAskedFor) {
  for (const double wall : {1.2, 2.0}) {
    constexpr double kVoxel = 0.3;
    Clay clay = Clay::ball(test::effort(6.0, 12.0), ClayOptions{.voxel_mm = kVoxel}).value();
    Hollow hollow;
    hollow.wall_mm = wall;
    ASSERT_TRUE(clay.apply(Operation(hollow)).ok());
    double most = 0.0;
    for (const Wall& found : walls_of(clay)) most = std::max(most, std::abs(found.mm - wall));
    EXPECT_LT(most, kVoxel) << wall;
    std::printf("hollow %g mm: off by %.4f mm at most\n", wall, most);
    mesh::Printer printer;
    printer.min_wall_mm = wall + kVoxel;
    EXPECT_FALSE(check_clay(clay, printer).value().verdict.printable);
    printer.min_wall_mm = wall - kVoxel;
    EXPECT_TRUE(check_clay(clay, printer).value().verdict.printable);
  }
}

/// A slab with a round pit `pit_mm` wide, under which 0.5 mm are left.
mesh::MeshVerdict judged_with_pit(double pit_mm) {
  const Clay clay = turned(
      [=](const Vec3& p) {
        const double slab = slab_distance(p, {6.0, 6.0, 1.0});
        const double pit = std::max(std::hypot(p.x, p.y) - 0.5 * pit_mm, -0.5 - p.z);
        return std::max(slab, -pit);
      },
      14.0);
  mesh::Printer printer;
  printer.min_wall_mm = 1.2;
  return check_clay(clay, printer).value().verdict;
}

/// As between triangles: over at least a square of what was asked.
TEST(FieldWall, CountsFromASquareOfTheLeastWallOn) {
  EXPECT_TRUE(judged_with_pit(0.9).printable);
  const mesh::MeshVerdict pit = judged_with_pit(2.4);
  EXPECT_FALSE(pit.printable);
  EXPECT_TRUE(pit.closed && pit.manifold && pit.outward);
  std::vector<double> thin;
  for (const mesh::MeshProblem& problem : pit.problems) {
    EXPECT_EQ(problem.kind, "thin_wall");
    const Vec3 at = rotate(conjugate(kTurn), problem.at_mm);
    EXPECT_LT(std::hypot(at.x, at.y), 1.2 + 1.2) << "in the pit or under it";
    thin.push_back(problem.size_mm);
  }
  ASSERT_FALSE(thin.empty());
  std::sort(thin.begin(), thin.end());
  EXPECT_NEAR(thin[thin.size() / 2], 0.5, kWallVoxelMm);
}

TEST(CheckClay, SaysWhatAnExportWouldSay) {
  const auto checked =
      check_clay(Clay::ball(5.0, ClayOptions{.voxel_mm = kWallVoxelMm}).value(), {});
  ASSERT_TRUE(checked) << checked.error().message;
  EXPECT_TRUE(checked.value().verdict.printable);
  EXPECT_EQ(checked.value().verdict.min_wall_mm, -1.0) << "not asked for";
  EXPECT_EQ(checked.value().verdict.marks.size(), checked.value().mesh.triangles.size());
}

TEST(CheckClay, StopsWhenAskedTo) {
  const auto checked = check_clay(Clay::ball(5.0, ClayOptions{.voxel_mm = kWallVoxelMm}).value(),
                                  {}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().kind, ErrorKind::interrupted);
}

}  // namespace
}  // namespace argil::io
