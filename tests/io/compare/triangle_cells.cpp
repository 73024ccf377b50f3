// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/triangle_cells.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "argil/core/closest_on_triangle.h"
#include "argil/core/vec3.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

std::set<CellIndex> cells_of(const mesh::Corners& corners) {
  std::set<CellIndex> cells;
  EXPECT_TRUE(TriangleCells(corners).for_each([&](const CellIndex& cell) {
    EXPECT_TRUE(cells.insert(cell).second) << "twice";
    return true;
  }));
  return cells;
}

/// All points of the triangle are in cells that are among its own. Returns how many cells have a
/// point that was looked at.
std::size_t expect_covered(const mesh::Corners& c, const std::set<CellIndex>& cells) {
  std::set<CellIndex> met;
  const int splits = 4 + static_cast<int>(3.0 * mesh::longest_side(c));
  for (int i = 0; i <= splits; ++i) {
    for (int j = 0; i + j <= splits; ++j) {
      const double u = static_cast<double>(i) / splits;
      const double v = static_cast<double>(j) / splits;
      const Vec3 p = c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]);
      CellIndex cell{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cell[axis] = static_cast<int>(std::floor(p[axis]));
      }
      EXPECT_EQ(cells.count(cell), 1U) << p.x << " " << p.y << " " << p.z;
      met.insert(cell);
    }
  }
  return met.size();
}

/// None is farther off than a cell: its middle less than one and a half diagonals.
void expect_near(const mesh::Corners& c, const std::set<CellIndex>& cells) {
  for (const CellIndex& cell : cells) {
    const Vec3 middle{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
    const Vec3 nearest = closest_on_triangle(middle, c[0], c[1], c[2]);
    EXPECT_LT(length(nearest - middle), 1.5 * std::sqrt(3.0));
  }
}

TEST(TriangleCellsProperty, HaveAllOfATriangleAndLittleElse) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto point = [&](double size) {
    return size * Vec3{place(random), place(random), place(random)};
  };
  std::size_t all = 0;
  std::size_t met = 0;
  for (int n = 0; n < 600; ++n) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", triangle " << n);
    const double size = n % 3 == 0 ? 0.7 : (n % 3 == 1 ? 4.0 : 20.0);
    const Vec3 at = point(1000.0);
    mesh::Corners c{at + point(size), at + point(size), at + point(size)};
    // Needles, and some whose corners are nodes, so that they lie in faces.
    if (n % 5 == 1) c[2] = c[0] + 0.3 * (c[1] - c[0]) + point(1e-3);
    if (n % 5 == 2) {
      for (Vec3& p : c) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    }
    if (n % 10 == 3) c[0].z = c[1].z = c[2].z = std::round(at.z);
    const std::set<CellIndex> cells = cells_of(c);
    met += expect_covered(c, cells);
    all += cells.size();
    // A triangle in faces has those on both sides of them.
    expect_near(c, cells);
  }
  EXPECT_LT(static_cast<double>(all), 2.5 * static_cast<double>(met));
}

TEST(TriangleCells, AreThoseOfASegmentOrAPointWithoutArea) {
  const mesh::Corners point{Vec3{0.5, 1.5, 2.5}, {0.5, 1.5, 2.5}, {0.5, 1.5, 2.5}};
  EXPECT_EQ(cells_of(point), (std::set<CellIndex>{{0, 1, 2}}));
  const mesh::Corners segment{Vec3{0.5, 0.5, 0.5}, {2.5, 3.5, 4.5}, {1.5, 2.0, 2.5}};
  expect_covered(segment, cells_of(segment));
}

TEST(TriangleCells, AreNoMoreWhereItIsSaidNo) {
  int asked = 0;
  const mesh::Corners wide{Vec3{0.1, 0.1, 0.1}, {9.0, 0.2, 0.3}, {0.3, 9.0, 0.4}};
  EXPECT_FALSE(TriangleCells(wide).for_each([&](const CellIndex&) { return ++asked < 5; }));
  EXPECT_EQ(asked, 5);
}

}  // namespace
}  // namespace argil::io
