// SPDX-License-Identifier: GPL-3.0-or-later
// Solids of which the thickness is known at every place, in as few triangles as they take, turned
// so that no axis helps: what is found, and what is not missed. ARGIL_TABLE=1 prints the table of
// docs/printing.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/mesh/check.h"
#include "argil/mesh/polygon_triangles.h"
#include "argil/mesh/wall_thickness.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kAskedMm = 0.8;

Vec3 askew(const Vec3& p) {
  return rotate(normalized(Quat{0.9, 0.3, -0.5, 0.2}), p) + Vec3{3, -7, 11};
}

TriangleMesh askew(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = askew(p);
  return mesh;
}

using Outline = std::vector<Vec3>;  ///< counter-clockwise, z = 0

/// An outline raised; scaled in x and y by `top` at its upper end.
TriangleMesh prism(const Outline& outline, double height, double top = 1.0) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const Vec3& p : outline) mesh.positions.push_back(p);
  for (const Vec3& p : outline) mesh.positions.push_back({top * p.x, top * p.y, height});
  for (const auto& [a, b, c] : triangulated(outline)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::uint32_t next = (n + 1) % count;
    mesh.triangles.push_back({n, next, next + count});
    mesh.triangles.push_back({n, next + count, n + count});
  }
  return mesh;
}

Outline circle(double radius, int sides) {
  Outline outline;
  for (int n = 0; n < sides; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
  }
  return outline;
}

TriangleMesh tube(double outer, double wall, double height) {
  constexpr std::uint32_t kSides = 96;
  TriangleMesh mesh;
  for (const double z : {0.0, height}) {
    for (const double radius : {outer, outer - wall}) {
      for (Vec3 p : circle(radius, kSides)) {
        p.z = z;
        mesh.positions.push_back(p);
      }
    }
  }
  const auto quad = [&](std::uint32_t from, std::uint32_t to, std::uint32_t n, std::uint32_t next) {
    mesh.triangles.push_back({from * kSides + n, from * kSides + next, to * kSides + next});
    mesh.triangles.push_back({from * kSides + n, to * kSides + next, to * kSides + n});
  };
  for (std::uint32_t n = 0; n < kSides; ++n) {
    const std::uint32_t next = (n + 1) % kSides;
    quad(0, 2, n, next);  // outside
    quad(3, 1, n, next);  // inside
    quad(2, 3, n, next);  // top
    quad(1, 0, n, next);  // bottom
  }
  return mesh;
}

/// Wedge of an angle with its edge along z, or cut off square at `from` if that is above 0; the
/// other corners are blunt.
TriangleMesh wedge(double degrees, double from) {
  constexpr double kLong = 20.0;
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vec3 along{std::cos(angle), std::sin(angle), 0.0};
  Outline outline = {{kLong, 0, 0}, {kLong, kLong * std::tan(0.5 * angle), 0}, kLong * along};
  if (from > 0.0) outline.push_back(from * along);
  outline.push_back({from, 0, 0});
  return prism(outline, 15.0);
}

/// Where the sides of a wedge are so thin: between them fits a ball of this.
double wedge_wall(double degrees, double from_edge) {
  return 2.0 * from_edge * std::tan(0.5 * degrees * std::numbers::pi / 180.0);
}

/// Strokes of a letter E, as wide as that.
Outline letter(double stroke) {
  const double w = stroke;
  return {{0, 0, 0},     {6, 0, 0},     {6, w, 0},  {w, w, 0},  {w, 5, 0},      {5, 5, 0},
          {5, 5 + w, 0}, {w, 5 + w, 0}, {w, 10, 0}, {6, 10, 0}, {6, 10 + w, 0}, {0, 10 + w, 0}};
}

struct Solid {
  std::string name;
  TriangleMesh mesh;
  double least_mm;         ///< the thinnest wall as far as parts tell; infinite: none below asked
  double thin_mm2 = -1.0;  ///< of the surface; -1: not told
  double asked_mm = kAskedMm;
  double edge_degrees = 0.0;  ///< of a sharp edge, where the wall ends in nothing
};

std::vector<Solid> boxes() {
  std::vector<Solid> solids;
  for (const double wall : {0.2, 0.4, 0.6, 0.79}) {
    solids.push_back({"plate of " + std::to_string(wall).substr(0, 4),
                      test::box_mesh({30, 40, wall}), wall, 2400.0});
  }
  for (const double wall : {0.81, 1.0, 3.0, 20.0}) {
    solids.push_back({"plate of " + std::to_string(wall).substr(0, 4),
                      test::box_mesh({30, 40, wall}), kNone, 0.0});
  }
  solids.push_back({"cube of 0.2", test::box_mesh({0.2, 0.2, 0.2}), 0.2, 0.24});
  solids.push_back({"plate of 2, asked 2.5", test::box_mesh({60, 80, 2}), 2.0, 9600.0, 2.5});
  solids.push_back({"bar of 0.5 by 0.5", test::box_mesh({30, 0.5, 0.5}), 0.5, 60.0});
  solids.push_back({"bar of 3 by 3", test::box_mesh({30, 3, 3}), kNone, 0.0});
  solids.push_back({"long plate of 0.5", test::box_mesh({180, 1, 0.5}), 0.5, 360.0});
  return solids;
}

std::vector<Solid> tapers() {
  std::vector<Solid> solids;
  // From 4 to what is told over 40: thin where less than 0.8.
  for (const double end : {0.1, 0.2, 0.5}) {
    const Outline side = {{0, 0, 0}, {40, 0, 0}, {40, end, 0}, {0, 4, 0}};
    const double thin = (kAskedMm - end) / ((4.0 - end) / 40.0);
    solids.push_back({"taper of 4 to " + std::to_string(end).substr(0, 3), prism(side, 40.0), end,
                      2.0 * thin * 40.0});
  }
  solids.push_back(
      {"taper of 4 to 1", prism({{0, 0, 0}, {40, 0, 0}, {40, 1, 0}, {0, 4, 0}}, 40.0), kNone, 0.0});
  for (const double degrees : {10.0, 20.0, 30.0, 45.0, 60.0}) {
    const double thin = kAskedMm / wedge_wall(degrees, 1.0);
    solids.push_back({"wedge of " + std::to_string(static_cast<int>(degrees)) + " degrees",
                      wedge(degrees, 0.0), 0.0, 2.0 * thin * 15.0, kAskedMm, degrees});
  }
  solids.push_back({"wedge of 75 degrees", wedge(75.0, 0.0), kNone, 0.0});
  solids.push_back({"cut wedge of 12 degrees", wedge(12.0, 2.0), wedge_wall(12.0, 2.0), -1.0});
  return solids;
}

std::vector<Solid> round_ones() {
  std::vector<Solid> solids;
  for (const double wall : {0.3, 0.6, 1.0, 3.0}) {
    const bool is_thin = wall < kAskedMm;
    solids.push_back({"tube of " + std::to_string(wall).substr(0, 3), tube(10.0, wall, 30.0),
                      is_thin ? wall : kNone,
                      is_thin ? 2.0 * std::numbers::pi * (20.0 - wall) * 30.0 : 0.0});
  }
  for (const double wall : {0.25, 0.5, 1.2}) {
    const bool is_thin = wall < kAskedMm;
    const double area = 4.0 * std::numbers::pi * (100.0 + std::pow(10.0 - wall, 2.0));
    solids.push_back(
        {"ball in a ball, " + std::to_string(wall).substr(0, 4),
         test::joined(test::ball_mesh(10.0, 5), test::inside_out(test::ball_mesh(10.0 - wall, 5))),
         is_thin ? wall : kNone, is_thin ? area : 0.0});
  }
  for (const double width : {0.4, 0.7, 2.0}) {
    const bool is_thin = width < kAskedMm;
    solids.push_back({"rod of " + std::to_string(width).substr(0, 3),
                      prism(circle(0.5 * width, 32), 20.0), is_thin ? width : kNone,
                      is_thin ? std::numbers::pi * width * 20.0 : 0.0});
  }
  solids.push_back({"ring of 0.6", test::torus_mesh(8.0, 0.3, 96, 24), 0.6,
                    4.0 * std::numbers::pi * std::numbers::pi * 8.0 * 0.3});
  solids.push_back({"ring of 4", test::torus_mesh(8.0, 2.0, 96, 24), kNone, 0.0});
  solids.push_back({"ball of 20", test::ball_mesh(10.0, 4), kNone, 0.0});
  solids.push_back({"cone of 12 degrees to 0.3", prism(circle(3.0, 48), 12.8, 0.05), 0.3, -1.0});
  return solids;
}

std::vector<Solid> letters() {
  std::vector<Solid> solids;
  for (const double stroke : {0.4, 0.6}) {
    // Sides that face one another across a stroke, its ends left out.
    solids.push_back({"letter of " + std::to_string(stroke).substr(0, 3),
                      prism(letter(stroke), 2.0), stroke, -1.0});
  }
  solids.push_back({"letter of 1.2", prism(letter(1.2), 2.0), kNone, 0.0});
  const Outline corner = {{0, 0, 0},     {10, 0, 0},   {10, 0.5, 0},
                          {0.5, 0.5, 0}, {0.5, 10, 0}, {0, 10, 0}};
  solids.push_back({"corner of two plates of 0.5", prism(corner, 10.0), 0.5, -1.0});
  return solids;
}

std::vector<Solid> all_solids() {
  std::vector<Solid> all;
  for (auto& some : {boxes(), tapers(), round_ones(), letters()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TEST(KnownWalls, AreFoundToATenthOfWhatIsAsked) {
  const bool prints = std::getenv("ARGIL_TABLE") != nullptr;
  const std::vector<Solid> solids = all_solids();
  EXPECT_GE(solids.size(), 40U);
  const Progress nobody;
  for (const Solid& solid : solids) {
    SCOPED_TRACE(solid.name);
    const TriangleMesh mesh = askew(solid.mesh);
    ASSERT_TRUE(check_mesh(mesh).printable);
    const auto start = std::chrono::steady_clock::now();
    const auto walls = wall_thickness(mesh, solid.asked_mm, Pace(nobody, "walls"));
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    double least = kNone;
    double thin = 0.0;
    for (const TriangleThickness& wall : walls) {
      if (wall.thin_mm2 > 0.0) least = std::min(least, wall.least_mm);
      thin += wall.thin_mm2;
    }
    if (prints) {
      std::printf("| %s | %.2f | %.2f | %.1f | %.1f | %.1f |\n", solid.name.c_str(), solid.least_mm,
                  least, solid.thin_mm2, thin, ms);
    }
    if (solid.least_mm == kNone) {
      EXPECT_EQ(least, kNone);
      EXPECT_EQ(thin, 0.0);
      continue;
    }
    if (solid.edge_degrees > 0.0) {
      // Parts are half as long as is asked, and their middles are what is looked at.
      EXPECT_LT(least, wedge_wall(solid.edge_degrees, 0.25 * solid.asked_mm));
    } else {
      EXPECT_NEAR(least, solid.least_mm, 0.1 * solid.asked_mm);
    }
    if (solid.thin_mm2 >= 0.0) {
      EXPECT_NEAR(thin, solid.thin_mm2, 0.1 * solid.thin_mm2);
    }
    EXPECT_FALSE(check_mesh(mesh, solid.asked_mm).printable);
  }
}

/// Also where a triangle is thin at a corner only, the place is one that is thin.
TEST(KnownWalls, AreToldWhereTheyAre) {
  const TriangleMesh taper = prism({{0, 0, 0}, {40, 0, 0}, {40, 0.2, 0}, {0, 4, 0}}, 40.0);
  const Progress nobody;
  const auto walls = wall_thickness(taper, kAskedMm, Pace(nobody, "walls"));
  int thin = 0;
  for (const TriangleThickness& wall : walls) {
    if (wall.thin_mm2 == 0.0) continue;
    ++thin;
    const double true_mm = 0.2 + (40.0 - wall.at_mm.x) * (4.0 - 0.2) / 40.0;
    EXPECT_NEAR(wall.least_mm, true_mm, 0.01 * kAskedMm);
    EXPECT_GT(wall.at_mm.x, 39.0);
  }
  EXPECT_EQ(thin, 4);
}

/// Two blocks beside each other, as far as told.
TEST(KnownGaps, AreFoundToATenthOfWhatIsAsked) {
  const Progress nobody;
  for (const double gap : {0.05, 0.2, 0.29, 0.31, 1.0}) {
    const TriangleMesh mesh = askew(test::joined(
        test::box_mesh({20, 20, 20}), test::box_mesh({20, 20, 20}, {20.0 + gap, 3.0, 0.0})));
    const auto gaps = gap_width(mesh, 0.3, Pace(nobody, "gaps"));
    double least = kNone;
    double narrow = 0.0;
    for (const TriangleThickness& each : gaps) {
      least = std::min(least, each.least_mm);
      narrow += each.thin_mm2;
    }
    EXPECT_NEAR(least, gap, 0.03);
    const double facing = 2.0 * 17.0 * 20.0;
    EXPECT_NEAR(narrow, gap < 0.3 ? facing : 0.0, 0.05 * facing);
    Printer printer;
    printer.min_gap_mm = 0.3;
    const auto verdict = check_print(mesh, printer);
    ASSERT_TRUE(verdict);
    EXPECT_TRUE(verdict.value().printable) << "a gap is told and does not count";
    const auto& problems = verdict.value().problems;
    const auto told = std::count_if(problems.begin(), problems.end(),
                                    [](const MeshProblem& p) { return p.kind == "narrow_gap"; });
    EXPECT_EQ(told > 0, gap < 0.3);
    EXPECT_NEAR(verdict.value().min_gap_mm, gap, 0.03);
  }
}

TEST(KnownGaps, AreNoneBesideASolidThatIsConvex) {
  const Progress nobody;
  for (const TriangleMesh& mesh : {test::ball_mesh(3.0, 3), test::box_mesh({1, 2, 3})}) {
    for (const TriangleThickness& gap : gap_width(mesh, 5.0, Pace(nobody, "gaps"))) {
      EXPECT_EQ(gap.thin_mm2, 0.0);
      EXPECT_EQ(gap.least_mm, kNone);
    }
  }
}

}  // namespace
}  // namespace argil::mesh
