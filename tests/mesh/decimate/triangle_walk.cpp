// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/triangle_walk.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/core/closest_on_triangle.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// A ball of large triangles, and a walk that has come to the one in front of a point.
struct RoughBall {
  RoughBall() : surface(test::ball_mesh(10.0, 2)), mesh(*CollapseMesh::build(surface)) {}

  TriangleWalk walk_to(const Vec3& at) const {
    TriangleWalk walk(mesh);
    walk.begin(0);
    walk.distance_far_mm(at, 0.0);
    walk.go_on();
    return walk;
  }
  Corners triangle_of_walk(const TriangleWalk& walk) const {
    const HalfEdge h = walk.triangle();
    return {mesh.position(mesh.from(h)), mesh.position(mesh.to(h)),
            mesh.position(mesh.to(next_in_triangle(h)))};
  }

  TriangleMesh surface;
  CollapseMesh mesh;
};

/// How far points of the piece's surface are from the triangle at most, of those of a grid.
double farthest(const SurfacePiece& piece, const Corners& c) {
  constexpr int kHalf = 10;
  double most = 0.0;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vec3 offset = piece.half_side_mm / kHalf * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        const double linear = piece.phi_mm + dot(piece.gradient, offset);
        if (std::abs(linear) > piece.bend_mm) continue;
        const Vec3 p = piece.middle_mm + offset;
        most = std::max(most, length(closest_on_triangle(p, c[0], c[1], c[2]) - p));
      }
    }
  }
  return most;
}

TEST(TriangleWalkProperty, CoversNothingThatIsFartherAndMostThatIsNot) {
  constexpr unsigned kSeed = 3;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const RoughBall ball;
  int near = 0;
  int found = 0;
  for (int n = 0; n < 3000; ++n) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", piece " << n);
    const Vec3 way = normalized(Vec3{place(random), place(random), place(random)});
    SurfacePiece piece;
    piece.half_side_mm = 0.1 + 0.2 * std::abs(place(random));
    piece.middle_mm = (9.7 + 0.5 * place(random)) * way;
    // Of a surface that lies about so, with a slope that is not 1 everywhere.
    const Vec3 askew = normalized(way + 0.3 * Vec3{place(random), place(random), place(random)});
    piece.gradient = (1.0 + 0.4 * place(random)) * askew;
    piece.phi_mm = piece.half_side_mm * place(random);
    piece.bend_mm = 0.05 * std::abs(place(random));
    TriangleWalk walk = ball.walk_to(piece.middle_mm);
    const double most = farthest(piece, ball.triangle_of_walk(walk));
    if (most == 0.0) continue;
    // Not even by a hair: a grid finds what is a tenth of the cube nearer at worst.
    EXPECT_FALSE(walk.covers(piece, 0.999 * most));
    EXPECT_TRUE(walk.relied_on().empty());
    ++near;
    if (!walk.covers(piece, most + 0.3 * piece.half_side_mm + piece.bend_mm)) continue;
    ++found;
    EXPECT_EQ(walk.relied_on(), std::vector<HalfEdge>{walk.triangle()});
  }
  // The rest reaches beyond a side of the triangle.
  EXPECT_GT(near, 2000);
  EXPECT_GT(found, near / 2);
}

TEST(TriangleWalk, TellsHowFarAParallelPieceIs) {
  const RoughBall ball;
  const Corners c = corners_of(ball.surface, 5);
  const Vec3 normal = normalized(area_normal(c));
  const Vec3 above = middle(c) + 0.3 * normal;
  SurfacePiece piece{above, 0.2, 0.0, 2.0 * normal, 0.02};
  TriangleWalk walk = ball.walk_to(above);
  // 0.02 of a function as steep as 2.
  EXPECT_TRUE(walk.covers(piece, 0.3101));
  EXPECT_FALSE(walk.covers(piece, 0.3099));
  piece.phi_mm = 0.2;
  EXPECT_TRUE(walk.covers(piece, 0.2101));
  EXPECT_FALSE(walk.covers(piece, 0.2099));
  piece.gradient = {};
  EXPECT_FALSE(walk.covers(piece, 100.0));
}

TEST(SheetWalks, GoOnOnTheFirstSheetWhereTheyWere) {
  const RoughBall ball;
  SheetWalks walks(ball.mesh);
  EXPECT_FALSE(walks.go_on());
  walks.begin(0);
  walks.begin_also(7);
  const Vec3 at{0.0, 0.0, 9.9};
  const double distance = walks.distance_far_mm(at, 0.0);
  const HalfEdge there = walks.walks()[0].triangle();
  EXPECT_TRUE(walks.go_on());
  ASSERT_EQ(walks.walks().size(), 1U);
  EXPECT_EQ(walks.walks()[0].triangle(), there);
  EXPECT_EQ(walks.distance_mm(at, 0.0), distance);
}

}  // namespace
}  // namespace argil::mesh
