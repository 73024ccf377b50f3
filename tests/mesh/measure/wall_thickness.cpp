// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of known thickness, turned so that no axis helps.
#include "argil/mesh/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/operation.h"
#include "argil/engine/surface.h"
#include "argil/mesh/check.h"

#include "support/effort.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

constexpr double kAllowed = 0.05;

Vec3 turned(const Vec3& p) {
  const Quat q = normalized(Quat{0.9, 0.3, -0.5, 0.2});
  return rotate(q, p) + Vec3{3, -7, 11};
}

TriangleMesh turned(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = turned(p);
  return mesh;
}

/// Of each triangle: by balls up to what is asked, beyond by rays.
std::vector<double> thickness_of(const TriangleMesh& mesh, double asked_mm) {
  const Progress nobody;
  std::vector<double> walls;
  for (const TriangleThickness& wall : wall_thickness(mesh, asked_mm, Pace(nobody, "walls"))) {
    walls.push_back(wall.least_mm);
  }
  return walls;
}

/// The thinnest and the middle one.
struct Walls {
  double least = 0.0;
  double median = 0.0;
};
Walls walls_of(const TriangleMesh& mesh) {
  std::vector<double> walls = thickness_of(mesh, 8.0);
  std::sort(walls.begin(), walls.end());
  return {walls.front(), walls[walls.size() / 2]};
}

TEST(WallThickness, OfSlabs) {
  for (const double thick : {0.1, 0.4, 2.0, 7.0}) {
    const Walls walls = walls_of(turned(test::box_mesh({30, 40, thick})));
    EXPECT_NEAR(walls.least, thick, kAllowed * thick);
  }
}

/// Flat sides make a tube of n of them thinner by up to 1 - cos(pi / n).
TEST(WallThickness, OfTubes) {
  constexpr int kSides = 96;
  for (const double thick : {0.3, 1.0, 3.0}) {
    TriangleMesh tube;
    const auto corner = [&](int n, int ring) {
      const double radius = ring == 0 || ring == 3 ? 10.0 : 10.0 - thick;
      const double angle = 2.0 * std::numbers::pi * n / kSides;
      const double z = ring < 2 ? -15.0 : 15.0;
      return turned({radius * std::cos(angle), radius * std::sin(angle), z});
    };
    for (int n = 0; n < kSides; ++n) {
      for (int ring = 0; ring < 4; ++ring) tube.positions.push_back(corner(n, ring));
    }
    const auto number = [](int n, int ring) {
      return static_cast<std::uint32_t>(4 * (n % kSides) + ring % 4);
    };
    for (int n = 0; n < kSides; ++n) {
      for (int ring = 0; ring < 4; ++ring) {
        tube.triangles.push_back({number(n, ring), number(n, ring + 1), number(n + 1, ring)});
        tube.triangles.push_back(
            {number(n + 1, ring), number(n, ring + 1), number(n + 1, ring + 1)});
      }
    }
    ASSERT_TRUE(check_mesh(tube).printable || check_mesh(test::inside_out(tube)).printable);
    if (!check_mesh(tube).printable) tube = test::inside_out(tube);
    const std::vector<double> walls = thickness_of(tube, 8.0);
    for (std::size_t t = 0; t < walls.size(); ++t) {
      const bool is_side = t / 2 % 2 == 1;  // of four rings the second and the fourth
      EXPECT_NEAR(walls[t], is_side ? thick : 30.0, kAllowed * thick);
    }
  }
}

/// A ray that ends at a vertex or an edge ends at several triangles.
TEST(WallThickness, IsTheSameToTheBitWhateverTheTreeAndTheNumberOfThreads) {
  const TriangleMesh torus = turned(test::torus_mesh(10.0, 4.0, 120, 120));
  const std::vector<double> walls = thickness_of(torus, 8.5);
  for (const unsigned seed : {1U, 2U}) {
    std::vector<std::size_t> order(walls.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    TriangleMesh other = torus;
    std::ranges::transform(order, other.triangles.begin(),
                           [&](std::size_t t) { return torus.triangles[t]; });
    const std::vector<double> again = thickness_of(other, 8.5);
    for (std::size_t n = 0; n < order.size(); ++n) ASSERT_EQ(again[n], walls[order[n]]) << n;
  }
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(thickness_of(torus, 8.5), walls) << threads;
  }
}

/// On the sides of a wedge the wall grows with the distance from its edge.
TEST(WallThickness, OfWedges) {
  constexpr int kSteps = 40;
  for (const double degrees : {4.0, 12.0, 25.0}) {
    const double slope = std::tan(degrees * std::numbers::pi / 180.0);
    TriangleMesh wedge;
    // From x = 1 to 20: below at z = 0, above at z = slope x.
    for (int n = 0; n <= kSteps; ++n) {
      const double x = 1.0 + 19.0 * n / kSteps;
      for (const double y : {0.0, 10.0}) {
        wedge.positions.push_back({x, y, 0.0});
        wedge.positions.push_back({x, y, slope * x});
      }
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      wedge.triangles.push_back({a, b, c});
      wedge.triangles.push_back({a, c, d});
    };
    for (std::uint32_t n = 0; n < kSteps; ++n) {
      const std::uint32_t a = 4 * n;
      quad(a, a + 2, a + 6, a + 4);      // below
      quad(a + 1, a + 5, a + 7, a + 3);  // above
      quad(a, a + 4, a + 5, a + 1);      // front
      quad(a + 2, a + 3, a + 7, a + 6);  // back
    }
    quad(0, 1, 3, 2);
    quad(4 * kSteps, 4 * kSteps + 2, 4 * kSteps + 3, 4 * kSteps + 1);
    const std::vector<double> walls = thickness_of(turned(wedge), 0.05);
    ASSERT_TRUE(check_mesh(wedge).printable);
    int seen = 0;
    for (std::size_t t = 0; t < wedge.triangles.size(); ++t) {
      const auto& [a, b, c] = wedge.triangles[t];
      const bool is_below =
          wedge.positions[a].z == 0.0 && wedge.positions[b].z == 0.0 && wedge.positions[c].z == 0.0;
      if (!is_below) continue;
      const double x = (wedge.positions[a].x + wedge.positions[b].x + wedge.positions[c].x) / 3.0;
      EXPECT_NEAR(walls[t], slope * x, kAllowed * slope * x) << degrees;
      ++seen;
    }
    EXPECT_EQ(seen, 2 * kSteps);
  }
}

/// A slab with a dent that leaves 0.1 mm over a spot as wide as `dent_mm`.
MeshVerdict judged_with_dent(double dent_mm) {
  TriangleMesh slab;
  constexpr int kSide = 40;
  const double cell = 10.0 / kSide;
  for (const double z : {0.0, 2.0}) {
    for (int i = 0; i <= kSide; ++i) {
      for (int j = 0; j <= kSide; ++j) {
        const double x = cell * i - 5.0;
        const double y = cell * j - 5.0;
        const bool is_dented = z > 0.0 && std::max(std::abs(x), std::abs(y)) <= dent_mm / 2.0;
        slab.positions.push_back({x, y, is_dented ? 0.1 : z});
      }
    }
  }
  const auto at = [](int layer, int i, int j) {
    return static_cast<std::uint32_t>((layer * (kSide + 1) + i) * (kSide + 1) + j);
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    slab.triangles.push_back({a, b, c});
    slab.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      quad(at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j));
      quad(at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1));
    }
    quad(at(0, i, 0), at(0, i + 1, 0), at(1, i + 1, 0), at(1, i, 0));
    quad(at(0, i, kSide), at(1, i, kSide), at(1, i + 1, kSide), at(0, i + 1, kSide));
    quad(at(0, 0, i), at(1, 0, i), at(1, 0, i + 1), at(0, 0, i + 1));
    quad(at(0, kSide, i), at(0, kSide, i + 1), at(1, kSide, i + 1), at(1, kSide, i));
  }
  return check_mesh(slab, 1.2);
}

TEST(WallThickness, CountsFromASquareOfTheLeastWallOn) {
  const MeshVerdict speck = judged_with_dent(0.6);
  EXPECT_TRUE(speck.printable);
  EXPECT_LT(speck.min_wall_mm, 1.2) << "it is measured all the same";
  const MeshVerdict dent = judged_with_dent(2.1);
  EXPECT_FALSE(dent.printable);
  EXPECT_NEAR(dent.min_wall_mm, 0.1, 0.005);
}

TEST(WallThickness, IsWhatHollowingWasAskedFor) {
  for (const double wall : {1.2, 2.0}) {
    Clay clay = Clay::ball(test::effort(6.0, 12.0), ClayOptions{.voxel_mm = 0.3}).value();
    Hollow hollow;
    hollow.wall_mm = wall;
    ASSERT_TRUE(clay.apply(Operation(hollow)).ok());
    const Walls walls = walls_of(extract_surface(clay));
    EXPECT_NEAR(walls.least, wall, 0.3);
    EXPECT_NEAR(walls.median, wall, 0.3);
  }
}

}  // namespace
}  // namespace argil::mesh
