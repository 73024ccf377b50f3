// SPDX-License-Identifier: GPL-3.0-or-later
// max_change_mm of a repair against distances by another way: every point of a dense lattice on the
// result, and every triangle of the input.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "argil/core/closest_on_triangle.h"
#include "argil/io/mesh_repair.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/surface_distance.h"
#include "support/effort.h"
#include "support/loose_triangles.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

double distance_by_all(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 q = closest_on_triangle(p, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    least = std::min(least, dot(p - q, p - q));
  }
  return std::sqrt(least);
}

struct DenseDistance {
  double greatest_mm = 0.0;
  double step_mm = 0.0;  ///< no point is farther from one that was asked
};

/// At corners and on a lattice of about `points` over the whole mesh.
DenseDistance dense_distance(const TriangleMesh& from, const TriangleMesh& to, double points) {
  const double step = std::sqrt(2.0 * surface_area(from) / points);
  std::vector<double> greatest(from.triangles.size(), 0.0);
  std::vector<double> reach(from.triangles.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, from.triangles.size(), [&](std::size_t t) {
    const mesh::Corners c = mesh::corners_of(from, t);
    const double side = mesh::longest_side(c);
    const int splits = std::max(1, static_cast<int>(std::ceil(side / step)));
    reach[t] = side / splits;
    for (int i = 0; i <= splits; ++i) {
      for (int j = 0; i + j <= splits; ++j) {
        const Vec3 p =
            c[0] + (1.0 * i / splits) * (c[1] - c[0]) + (1.0 * j / splits) * (c[2] - c[0]);
        greatest[t] = std::max(greatest[t], distance_by_all(to, p));
      }
    }
  });
  return {*std::max_element(greatest.begin(), greatest.end()),
          *std::max_element(reach.begin(), reach.end())};
}

using Break = std::function<TriangleMesh(TriangleMesh, std::mt19937&)>;

TriangleMesh with_holes(TriangleMesh mesh, std::mt19937& random) {
  for (int n = 0; n < 9; ++n) {
    mesh = test::without(std::move(mesh), random() % mesh.triangles.size());
  }
  return mesh;
}

TriangleMesh with_noise(TriangleMesh mesh, std::mt19937& random) {
  std::normal_distribution<double> off(0.0, 0.1);
  for (Vec3& p : mesh.positions) p += Vec3{off(random), off(random), off(random)};
  return mesh;
}

TriangleMesh with_a_crossing_box(TriangleMesh mesh, std::mt19937& random) {
  std::normal_distribution<double> at(0.0, 4.0);
  return test::joined(mesh, test::box_mesh({7, 6, 5}, {at(random), at(random), at(random)}));
}

TriangleMesh with_a_bite(TriangleMesh mesh, std::mt19937& random) {
  const Vec3 at = mesh.positions[random() % mesh.positions.size()];
  std::erase_if(mesh.triangles,
                [&](const Triangle& t) { return length(mesh.positions[t[0]] - at) < 3.0; });
  return mesh;
}

TriangleMesh as_apart(TriangleMesh mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> off(-0.4, 0.4);
  TriangleMesh soup = test::loose_triangles(mesh);
  for (Vec3& p : soup.positions) p += Vec3{off(random), off(random), off(random)};
  return soup;
}

/// Two shapes in three ways broken; all five ways three times each when thorough.
TEST(RepairBound, IsNeverBrokenAndWithinItsSlack) {
  const std::vector<std::pair<const char*, Break>> ways{{"holes", with_holes},
                                                        {"bite", with_a_bite},
                                                        {"box", with_a_crossing_box},
                                                        {"noise", with_noise},
                                                        {"apart", as_apart}};
  const std::vector<TriangleMesh> shapes{test::ball_mesh(10.0, 3),
                                         test::torus_mesh(10.0, 4.0, 40, 20)};
  const int rounds = test::effort(1, 3);
  const std::size_t count = test::effort(std::size_t{3}, ways.size());
  std::mt19937 random(11);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t n = 0; n < count; ++n) {
      for (const TriangleMesh& shape : shapes) {
        SCOPED_TRACE(ways[n].first);
        const TriangleMesh broken = mesh::rounded_to_float(ways[n].second(shape, random));
        const auto repaired = repair_mesh(broken, {.voxel_mm = 0.4});
        ASSERT_TRUE(repaired) << repaired.error().message;
        const RepairReport& report = repaired.value().report;
        const DenseDistance dense =
            dense_distance(repaired.value().mesh, broken, test::effort(3e4, 1e5));
        EXPECT_LE(dense.greatest_mm, report.max_change_mm + 1e-9);
        EXPECT_GE(dense.greatest_mm + dense.step_mm,
                  report.max_change_mm - report.max_change_slack_mm);
        EXPECT_LE(report.max_change_slack_mm, std::max(3e-3, 0.02 * report.max_change_mm));
        std::printf("%s: bound %.6f slack %.6f, found %.6f\n", ways[n].first, report.max_change_mm,
                    report.max_change_slack_mm, dense.greatest_mm);
      }
    }
  }
}

/// A corner of the one in the middle of a face of the other, where no vertex of it is near.
TEST(RepairBound, OfBoxesIsTheWayToTheirFaces) {
  const TriangleMesh large = test::box_mesh({20, 20, 20});
  const TriangleMesh small = test::box_mesh({2, 2, 2});
  const GreatestDistance from_small = greatest_distance(small, large, 1e-3);
  EXPECT_NEAR(from_small.at_most_mm, 9.0, 1e-9);
  EXPECT_EQ(from_small.at_most_mm, from_small.at_least_mm);
  // From the middle of the face of the large one it is 9, from its corners more.
  const GreatestDistance from_large = greatest_distance(large, small, 1e-3);
  EXPECT_NEAR(from_large.at_least_mm, 9.0 * std::sqrt(3.0), 1e-9);
  // In the middle between two plates a sheet is as far from both.
  const TriangleMesh plates = test::joined(test::box_mesh({20, 20, 1}, {0, 0, 5.5}),
                                           test::box_mesh({20, 20, 1}, {0, 0, -5.5}));
  TriangleMesh sheet;
  sheet.positions = {{-9, -9, -5}, {9, -9, -5}, {0, 9, 5}};
  sheet.triangles = {{0, 1, 2}};
  const GreatestDistance between = greatest_distance(sheet, plates, 1e-3);
  EXPECT_GE(between.at_most_mm, 5.0 - 1e-9);
  EXPECT_NEAR(between.at_least_mm, 5.0, 0.101);
}

}  // namespace
}  // namespace argil::io
