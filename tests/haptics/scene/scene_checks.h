// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics::scenes {

inline HandleState at(const Vec3& position_mm, const Vec3& velocity_mm_per_s = {}) {
  HandleState place;
  place.position_mm = position_mm;
  place.velocity_mm_per_s = velocity_mm_per_s;
  return place;
}

inline Vec3 force(const ForceScene& scene, const Vec3& position_mm,
                  const Vec3& velocity_mm_per_s = {}) {
  return scene.force_at(at(position_mm, velocity_mm_per_s)).force_n;
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

inline Vec3 random_in_cube(std::mt19937_64& random, double half) {
  std::uniform_real_distribution<double> side(-half, half);
  const double x = side(random);
  const double y = side(random);
  return {x, y, side(random)};
}

/// A number that is likely to be trouble: zero, denormal, huge, or any within the workspace.
inline double awkward_number(std::mt19937_64& random) {
  static constexpr std::array<double, 16> kAwkward{0.0,    -0.0,  5e-324, 1e-162, -1e-162, 1e-9,
                                                   1.0,    -20.0, 40.0,   50.0,   -80.0,   80.0,
                                                   2.15e9, 1e18,  1e154,  -1e308};
  const std::size_t which = random() % (kAwkward.size() + 8);
  if (which == kAwkward.size()) {
    return std::numeric_limits<double>::max();
  }
  return which < kAwkward.size() ? kAwkward[which]
                                 : std::uniform_real_distribution<double>(-100.0, 100.0)(random);
}

/// Every finite position and velocity gives a finite force and a finite stiffness, not negative.
inline void expect_finite_everywhere(ForceScene& scene) {
  std::mt19937_64 random(5);
  const auto awkward = [&random] {
    const double x = awkward_number(random);
    const double y = awkward_number(random);
    return Vec3{x, y, awkward_number(random)};
  };
  for (int n = 0; n < 200000; ++n) {
    const Vec3 position = awkward();
    const HandleState place = at(position, awkward());
    scene.begin_tick(place);
    const SceneForce felt = scene.force_at(place);
    ASSERT_TRUE(is_finite(felt.force_n))
        << position.x << " " << position.y << " " << position.z << " moving at "
        << place.velocity_mm_per_s.x << " " << place.velocity_mm_per_s.y << " "
        << place.velocity_mm_per_s.z;
    ASSERT_GE(felt.stiffness_n_per_m, 0.0);
    ASSERT_LE(felt.stiffness_n_per_m, 1e30);
  }
}

/// The stiffness that is reported is the slope of the force along `normal`.
inline void expect_stiffness_is_the_slope(const ForceScene& scene, const Vec3& place_mm,
                                          const Vec3& normal, double relative_tolerance) {
  constexpr double kStepMm = 1e-5;
  const double less = dot(force(scene, place_mm + kStepMm * normal), normal);
  const double more = dot(force(scene, place_mm - kStepMm * normal), normal);
  const double slope_n_per_m = (more - less) / (2.0 * kStepMm) * 1e3;
  EXPECT_NEAR(scene.force_at(at(place_mm)).stiffness_n_per_m, slope_n_per_m,
              relative_tolerance * slope_n_per_m);
}

}  // namespace argil::haptics::scenes
