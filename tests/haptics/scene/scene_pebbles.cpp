// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_pebbles.h"

#include <algorithm>
#include <cmath>

#include "haptics/scene/scene_checks.h"
#include "scene/contact.h"
#include "scene/pebble_block.h"

namespace argil::haptics {
namespace {

using namespace scenes;

PebblesOptions grid(int side) {
  PebblesOptions options;
  options.columns = side;
  options.rows = side;
  options.spacing_mm = 6.0;
  options.radius_mm = 5.0;
  return options;
}

/// How many spheres force_at looks at there.
int candidates_at(const PebblesOptions& options, const Vec3& position_mm) {
  return pebble_block(options, bounded(position_mm)).count();
}

/// Equation 3.15 for every sphere of the grid, one after the other.
Vec3 brute_force(const PebblesOptions& options, const HandleState& place) {
  Vec3 sum;
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      Vec3 out = place.position_mm - options.center_mm;
      out.x -= (column - 0.5 * (options.columns - 1)) * options.spacing_mm;
      out.y -= (row - 0.5 * (options.rows - 1)) * options.spacing_mm;
      const double d = length(out);
      if (d >= options.radius_mm || d <= 0.0) {
        continue;
      }
      const double speed = dot(place.velocity_mm_per_s, out) / d;
      const double push =
          -options.stiffness_n_per_m * (d - options.radius_mm) - options.damping_n_s_per_m * speed;
      sum += std::max(0.0, push / 1e3) * (out / d);
    }
  }
  return sum;
}

/// Places within the bed of pebbles and a little beyond its edges.
Vec3 random_in_bed(std::mt19937_64& random, const PebblesOptions& options) {
  Vec3 place = random_in_cube(random, 1.0);
  place.x *= 0.5 * options.columns * options.spacing_mm + options.radius_mm;
  place.y *= 0.5 * options.rows * options.spacing_mm + options.radius_mm;
  place.z *= 1.1 * options.radius_mm;
  return options.center_mm + place;
}

void expect_equals_brute_force(const PebblesOptions& options, int places) {
  const PebblesScene scene(options);
  std::mt19937_64 random(6);
  double worst = 0.0;
  int touched = 0;
  for (int n = 0; n < places; ++n) {
    const HandleState place = at(random_in_bed(random, options), random_in_cube(random, 100.0));
    const Vec3 felt = scene.force_at(place).force_n;
    worst = std::max(worst, length(felt - brute_force(options, place)));
    touched += felt != Vec3{} ? 1 : 0;
  }
  EXPECT_LE(worst, 1e-12) << options.columns << " x " << options.rows;
  EXPECT_GT(touched, places / 4);
  ::testing::Test::RecordProperty("worst_n_" + std::to_string(options.columns),
                                  std::to_string(worst * 1e15) + "e-15");
}

TEST(Equation3_15, EqualsTheSumOverAllSpheres) {
  expect_equals_brute_force({}, 20000);
  expect_equals_brute_force(grid(5), 20000);
  expect_equals_brute_force(grid(50), 2000);
  expect_equals_brute_force(grid(500), 40);
  PebblesOptions widest = grid(6);
  widest.rows = 3;
  widest.center_mm = {3, -4, 10};
  widest.radius_mm = 1.5 * widest.spacing_mm;
  expect_equals_brute_force(widest, 20000);
}

TEST(Equation3_15, LooksAtAsManySpheresInAnyGrid) {
  const PebblesOptions small = grid(5);
  const PebblesOptions large = grid(500);
  std::mt19937_64 random(7);
  int most_small = 0;
  int most_large = 0;
  for (int n = 0; n < 100000; ++n) {
    most_small = std::max(most_small, candidates_at(small, random_in_bed(random, small)));
    most_large = std::max(most_large, candidates_at(large, random_in_bed(random, large)));
  }
  EXPECT_EQ(most_small, 9);
  EXPECT_EQ(most_large, 9);
  EXPECT_EQ(candidates_at(small, {0, 0, -20}), candidates_at(large, {3, 3, -20}));
  EXPECT_EQ(candidates_at(small, {1e300, 0, -20}), 0);
  EXPECT_EQ(candidates_at(small, {0, 0, -14}), 0);
}

TEST(Equation3_15, OneSphereFollowsThePrintedLaw) {
  const PebblesScene one(grid(1));
  expect_near(force(one, {0, 0, -16}), {0, 0, 1}, 1e-12);
  expect_near(force(one, {0, 0, -16}, {50, 50, -100}), {0, 0, 1.5}, 1e-12);
  EXPECT_EQ(force(one, {0, 0, -16}, {0, 0, 1000}), Vec3{});
  EXPECT_EQ(force(one, {0, 0, -15}), Vec3{});
  EXPECT_EQ(force(one, {0, 0, -20}), Vec3{});
}

TEST(Equation3_15, OverlappingSpheresAddUp) {
  PebblesOptions two = grid(1);
  two.columns = 2;
  const PebblesScene scene(two);
  // 3 mm above the middle between them: each is 3 sqrt(2) away, and what is sideways cancels.
  const double d = std::hypot(3.0, 3.0);
  expect_near(force(scene, {0, 0, -17}), {0, 0, 2.0 * (5.0 - d) * 3.0 / d}, 1e-12);
}

TEST(Equation3_15, CarriesALightHand) {
  // The most that each point of a cell pushes up at any height; the weakest is by the hollow
  // between four pebbles.
  const PebblesScene scene;
  double weakest = 1e9;
  for (int i = 0; i <= 25; ++i) {
    for (int j = 0; j <= 25; ++j) {
      double most = 0.0;
      for (int h = 0; h <= 60; ++h) {
        most = std::max(most, force(scene, {0.1 * i, 0.1 * j, -20.0 + 0.1 * h}).z);
      }
      weakest = std::min(weakest, most);
    }
  }
  EXPECT_GE(weakest, 3.5);
  EXPECT_LE(weakest, 3.7);
  RecordProperty("weakest_n", std::to_string(weakest));
}

TEST(Equation3_15, StiffnessIsTheSlope) {
  expect_stiffness_is_the_slope(PebblesScene(grid(1)), {0, 0, -16}, {0, 0, 1}, 1e-6);
  EXPECT_EQ(PebblesScene(grid(1)).force_at(at({0, 0, -14})).stiffness_n_per_m, 0.0);
  // Two spheres share it by the squares of their cosines.
  PebblesOptions two = grid(1);
  two.columns = 2;
  EXPECT_NEAR(PebblesScene(two).force_at(at({0, 0, -17})).stiffness_n_per_m, 1000.0, 1e-9);
}

TEST(Equation3_15, IsFiniteForAnyFinitePlace) {
  PebblesScene scene;
  expect_finite_everywhere(scene);
}

TEST(Equation3_18, ForceIsParallelToTheLineOfCenters) {
  PebblesOptions options;
  options.spacing_mm = 13.0;  // no overlap
  const PebblesScene scene(options);
  std::mt19937_64 random(8);
  for (int n = 0; n < 20000; ++n) {
    const int column = static_cast<int>(random() % 21);
    const int row = static_cast<int>(random() % 21);
    const Vec3 out = 5.9 * normalized(random_in_cube(random, 1.0));
    const Vec3 f =
        force(scene, scene.sphere_center_mm(column, row) + out, random_in_cube(random, 10.0));
    ASSERT_LE(length(cross(f, normalized(out))), 1e-12);
    ASSERT_GE(dot(f, out), 0.0);
  }
}

}  // namespace
}  // namespace argil::haptics
