// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/triangle_runs.h"

#include <algorithm>
#include <limits>
#include <random>
#include <string_view>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace argil::io {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

TEST(TriangleRunsProperty, FindWhatATreeFinds) {
  constexpr unsigned kSeed = 5;
  std::mt19937 dice(kSeed);
  const Progress nobody;
  std::uniform_real_distribution<double> place(-14.0, 14.0);
  TriangleMesh mesh = test::joined(test::torus_mesh(10.0, 3.0, 30, 20), test::ball_mesh(2.0, 3));
  for (const bool is_shuffled : {false, true}) {
    if (is_shuffled) std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), dice);
    const MeshDistance tree(mesh.positions, mesh.triangles);
    const TriangleRuns runs(mesh, Pace(nobody, ""));
    for (int n = 0; n < 500; ++n) {
      const Vec3 at{place(dice), place(dice), place(dice)};
      const auto wanted = tree.closest(at, kAnywhere);
      const auto found = runs.closest(at, {kAnywhere, kNoTriangle});
      ASSERT_NEAR(found.distance, wanted.distance, 1e-12) << "seed " << kSeed << ", point " << n;
      const auto nearer = runs.closest(at, {0.5 * wanted.distance, 7});
      ASSERT_EQ(nearer.triangle, 7U) << "seed " << kSeed << ", point " << n;
    }
  }
}

TEST(TriangleRuns, HearAnInterruptionWhileTheyAreMade) {
  const TriangleMesh mesh = test::ball_mesh(10.0, 8);
  int heard = 0;
  const Progress listen = [&](std::string_view, double) { return ++heard < 3; };
  EXPECT_THROW(TriangleRuns(mesh, Pace(listen, "")), Interrupted);
  EXPECT_EQ(heard, 3);
}

}  // namespace
}  // namespace argil::io
