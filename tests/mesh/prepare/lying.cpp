// SPDX-License-Identifier: GPL-3.0-or-later
// What a piece lies on when it is laid flat.
#include <cmath>
#include <cstddef>
#include <random>
#include <string_view>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/print_orientation.h"

#include "support/profile_solids.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

/// Work that nobody asks to stop.
Pace unheard() {
  static const Progress kUnheard;
  return Pace(kUnheard, "lying");
}

TriangleMesh turned_mesh(TriangleMesh mesh, const Quat& turn) {
  for (Vec3& p : mesh.positions) p = rotate(turn, p);
  return mesh;
}

TEST(LyingOnMost, IsTheLargestSideOfABoxHoweverItStands) {
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  for (int n = 0; n < 20; ++n) {
    const Quat turn = normalized(Quat{any(random), any(random), any(random), any(random)});
    const TriangleMesh box = turned_mesh(test::box_mesh({10.0, 30.0, 20.0}), turn);
    const Vec3 up = lying_on_most(box, {0.0, 0.0, 1.0}, 0.0, unheard());
    EXPECT_NEAR(std::abs(dot(up, rotate(turn, Vec3{1.0, 0.0, 0.0}))), 1.0, 1e-9);
  }
}

TEST(LyingOnMost, StaysWhereNoOtherSideIsLarger) {
  const TriangleMesh cube = test::box_mesh({10.0, 10.0, 10.0});
  for (const Vec3& up : {Vec3{0.0, 0.0, 1.0}, Vec3{0.0, -1.0, 0.0}}) {
    EXPECT_EQ(lying_on_most(cube, up, 0.01, unheard()), up);
  }
}

TEST(LyingOnMost, IsNoSideThatItWouldTipFrom) {
  // A cone has its base, and its side, which is longer but narrow; upside down it cannot stand on
  // the larger of its ends when the smaller one is all that is below.
  const TriangleMesh cone = test::revolved({{10.0, 0, 0}, {0.001, 0, 30}, {0.001, 0, 0}}, 64);
  const Vec3 up = lying_on_most(cone, normalized(Vec3{0.3, 0.0, -1.0}), 0.0, unheard());
  EXPECT_NEAR(up.z, 1.0, 1e-9);
}

/// Points of the sides lie up to a twentieth of a millimetre off: no two triangles are in a plane.
TEST(LyingOnMost, TakesARoughSideAsAWholeWithinTheSlack) {
  TriangleMesh box = test::revolved({{12.0, 0, 0}, {12.0, 0, 8}, {0.001, 0, 8}, {0.001, 0, 0}}, 48);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.05, 0.05);
  for (Vec3& p : box.positions) p = p + Vec3{off(random), off(random), off(random)};
  const Vec3 up = lying_on_most(box, normalized(Vec3{1.0, 0.2, 0.1}), 0.1, unheard());
  EXPECT_GT(std::abs(up.z), 0.999);
}

/// Both while directions are tried and while sides are measured, and without delay.
TEST(LyingOnMost, StopsWhenItIsAskedTo) {
  const TriangleMesh cube = test::box_mesh({10.0, 10.0, 10.0});
  int asked = 0;
  double last = -1.0;
  const Progress all = [&](std::string_view, double fraction) {
    EXPECT_GT(fraction, last);
    EXPECT_LT(fraction, 1.0);
    last = fraction;
    ++asked;
    return true;
  };
  lying_on_most(cube, {0.0, 0.0, 1.0}, 0.01, Pace(all, "lying"));
  ASSERT_GT(asked, 205) << "200 directions, and a cube's six sides";
  for (const int most : {1, 100, 200, asked}) {
    int told = 0;
    const Progress few = [&](std::string_view, double) { return ++told < most; };
    EXPECT_THROW(lying_on_most(cube, {0.0, 0.0, 1.0}, 0.01, Pace(few, "lying")), Interrupted);
    EXPECT_EQ(told, most);
  }
}

TEST(LyingOnMostGolden, GivesTheSameBitsForAnyThreadCount) {
  const TriangleMesh cone =
      turned_mesh(test::revolved({{10.0, 0, 0}, {6.0, 0, 30}, {0.001, 0, 30}, {0.001, 0, 0}}, 40),
                  normalized(Quat{1.0, 0.4, 0.2, 0.1}));
  const Vec3 all = lying_on_most(cone, {0.0, 0.0, 1.0}, 0.1, unheard());
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(lying_on_most(cone, {0.0, 0.0, 1.0}, 0.1, unheard()), all);
  }
}

}  // namespace
}  // namespace argil::mesh
