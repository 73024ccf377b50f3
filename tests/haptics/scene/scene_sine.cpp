// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_sine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

constexpr double kDegrees = 180.0 / std::numbers::pi;

SineOptions towards(SineDirection direction) {
  SineOptions options;
  options.direction = direction;
  return options;
}

/// The angle of two unit vectors in degrees, exact where it is small.
double angle_between(const Vec3& a, const Vec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * length(a - b))) * kDegrees;
}

/// The work of the force along a straight way, mJ (N mm), by the middle of short steps.
double work_along(const ForceScene& scene, const Vec3& from, const Vec3& to) {
  constexpr int kSteps = 20000;
  const Vec3 step = (to - from) / kSteps;
  double work = 0.0;
  for (int n = 0; n < kSteps; ++n) {
    work += dot(force(scene, from + (n + 0.5) * step), step);
  }
  return work;
}

/// The work around the rectangle x +-12.5, z -26 to -10 mm at y = 0: along the bottom to +x, up,
/// back and down.
double loop_work(SineDirection direction, bool other_way = false) {
  const SineScene scene(towards(direction));
  const std::array<Vec3, 5> corner{
      {{-12.5, 0, -26}, {12.5, 0, -26}, {12.5, 0, -10}, {-12.5, 0, -10}, {-12.5, 0, -26}}};
  double work = 0.0;
  for (std::size_t n = 0; n + 1 < corner.size(); ++n) {
    work += other_way ? work_along(scene, corner[n + 1], corner[n])
                      : work_along(scene, corner[n], corner[n + 1]);
  }
  return work;
}

/// The error of a direction over many points, in degrees.
struct DirectionError {
  double rms = 0.0;
  double most = 0.0;
};
DirectionError direction_error(const SineOptions& options) {
  const SineScene scene(options);
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> wave(-50.0, 50.0);
  DirectionError error;
  constexpr int kPlaces = 200000;
  for (int n = 0; n < kPlaces; ++n) {
    const double x = wave(random);
    const double y = wave(random);
    const double angle = angle_between(scene.direction_at(x, y), normalized(scene.normal_at(x, y)));
    error.rms += angle * angle;
    error.most = std::max(error.most, angle);
  }
  error.rms = std::sqrt(error.rms / kPlaces);
  return error;
}
DirectionError table_error(SineDirection direction, double spacing_mm) {
  SineOptions options = towards(direction);
  options.table_spacing_mm = spacing_mm;
  return direction_error(options);
}

TEST(Equation3_16, HeightIsThePrintedSurface) {
  SineOptions options;
  options.frequency_y_per_m = 10.0;
  const SineScene scene(options);
  EXPECT_NEAR(scene.height_mm(0, 33), -20.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(12.5, 0), -15.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(-12.5, 0), -25.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(12.5, 25), -20.0, 1e-12);
  EXPECT_NEAR(scene.height_mm(12.5, 50), -25.0, 1e-12);
}

TEST(Equation3_16, SlopeIs32DegreesAtMostAnd23InTheMean) {
  const SineScene scene;
  double sum = 0.0;
  double most = 0.0;
  constexpr int kSide = 1000;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Vec3 n = scene.normal_at(50.0 * i / kSide, 50.0 * j / kSide);
      const double slope = std::atan(std::hypot(n.x, n.y)) * kDegrees;
      sum += slope;
      most = std::max(most, slope);
    }
  }
  EXPECT_NEAR(most, 32.1, 0.05);
  EXPECT_NEAR(sum / (kSide * kSide), 22.8, 0.05);
  RecordProperty("most", std::to_string(most));
  RecordProperty("mean", std::to_string(sum / (kSide * kSide)));
}

TEST(Equation3_17, PushesAlongZWithTheDepthBelowTheSurface) {
  SineOptions options = towards(SineDirection::z_only);
  options.damping_n_s_per_m = 10.0;
  const SineScene scene(options);
  expect_near(force(scene, {12.5, 0, -18}), {0, 0, 3}, 1e-12);
  expect_near(force(scene, {12.5, 0, -18}, {300, 300, -100}), {0, 0, 4}, 1e-12);
  EXPECT_EQ(force(scene, {12.5, 0, -18}, {0, 0, 1000}), Vec3{});
  EXPECT_EQ(force(scene, {12.5, 0, -14.999}), Vec3{});
  EXPECT_EQ(scene.force_at(at({12.5, 0, -14.999})).stiffness_n_per_m, 0.0);
}

TEST(Equation3_17, TakesOrGives60MillijouleInALoop) {
  const double work = loop_work(SineDirection::z_only);
  EXPECT_NEAR(work, 60.0, 0.06);
  EXPECT_NEAR(loop_work(SineDirection::z_only, true), -work, 1e-9);
  RecordProperty("work_mj", std::to_string(work));
}

TEST(Equation3_19to3_22, DerivativesAreThoseOfTheSurface) {
  SineOptions options;
  options.frequency_y_per_m = 13.0;
  const SineScene scene(options);
  constexpr double kStep = 1e-3;
  std::mt19937_64 random(11);
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const Vec3 p = random_in_cube(random, 100.0);
    const Vec3 normal = scene.normal_at(p.x, p.y);
    const double dx =
        (scene.height_mm(p.x + kStep, p.y) - scene.height_mm(p.x - kStep, p.y)) / (2.0 * kStep);
    const double dy =
        (scene.height_mm(p.x, p.y + kStep) - scene.height_mm(p.x, p.y - kStep)) / (2.0 * kStep);
    worst = std::max(worst, std::hypot(normal.x + dx, normal.y + dy));
    ASSERT_EQ(normal.z, 1.0);
  }
  // Relative to the steepest slope, 2 pi f_x A.
  EXPECT_LE(worst / 0.6283, 1e-6);
  RecordProperty("worst_1e9", std::to_string(worst / 0.6283 * 1e9));
}

TEST(Equation3_19to3_22, UnitNormalCarriesTheForceOfTheDepth) {
  SineOptions options = towards(SineDirection::unit_normal);
  options.damping_n_s_per_m = 10.0;
  const SineScene scene(options);
  std::mt19937_64 random(12);
  for (int n = 0; n < 10000; ++n) {
    Vec3 p = random_in_cube(random, 50.0);
    p.z = scene.height_mm(p.x, p.y) - 2.0;
    const Vec3 f = force(scene, p, {0, 0, -50});
    ASSERT_NEAR(length(f), 2.5, 1e-9);
    ASSERT_LE(length(cross(f, scene.normal_at(p.x, p.y))), 1e-9);
  }
}

TEST(Equation3_19to3_22, UnitNormalTakesOrGives6MillijouleInALoop) {
  const double work = loop_work(SineDirection::unit_normal);
  EXPECT_NEAR(std::abs(work), 6.43, 0.0643);
  EXPECT_NEAR(loop_work(SineDirection::unit_normal, true), -work, 1e-9);
  RecordProperty("work_mj", std::to_string(work));
}

TEST(Equation3_19to3_22, GradientDoesNoWorkInALoop) {
  const double work = loop_work(SineDirection::gradient);
  EXPECT_NEAR(work, 0.0, 1e-3);
  RecordProperty("work_nj", std::to_string(work * 1e6));
}

TEST(Equation3_19to3_22, GradientIsThatOfTheStoredEnergy) {
  const SineScene scene;
  const auto energy_mj = [&scene](const Vec3& p) {
    const double depth = std::max(0.0, scene.height_mm(p.x, p.y) - p.z);
    return 0.5 * depth * depth;  // 1000 N/m is 1 N/mm
  };
  constexpr double kStep = 1e-3;
  std::mt19937_64 random(13);
  for (int n = 0; n < 10000; ++n) {
    Vec3 p = random_in_cube(random, 50.0);
    p.z = scene.height_mm(p.x, p.y) - 3.0;
    Vec3 slope;
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 step;
      step[a] = kStep;
      slope[a] = (energy_mj(p + step) - energy_mj(p - step)) / (2.0 * kStep);
    }
    expect_near(force(scene, p), -slope, 3e-6);
  }
}

TEST(Equation3_19to3_22, DampingOfTheGradientAlwaysTakesEnergy) {
  SineOptions damped;
  damped.damping_n_s_per_m = 10.0;
  const SineScene scene(damped);
  const SineScene spring;
  std::mt19937_64 random(14);
  for (int n = 0; n < 10000; ++n) {
    const Vec3 p = random_in_cube(random, 50.0);
    const Vec3 v = random_in_cube(random, 100.0);
    const Vec3 damper = force(scene, p, v) - force(spring, p, v);
    ASSERT_LE(dot(damper, v), 1e-9);
    ASSERT_GE(force(scene, p, v).z, 0.0);
  }
}

TEST(Equation3_19to3_22, DampingAsPrintedCanGiveEnergy) {
  SineOptions options = towards(SineDirection::unit_normal);
  const SineScene spring(options);
  options.damping_n_s_per_m = 10.0;
  const SineScene damped(options);
  // Into the flank that rises towards +x, and a little upwards.
  const Vec3 place{0, 0, -22};
  const Vec3 velocity{100, 0, 20};
  EXPECT_GT(dot(force(damped, place, velocity) - force(spring, place, velocity), velocity), 0.0);
}

TEST(Equation3_19to3_22, StiffnessIsTheSlopeAlongTheNormal) {
  for (const auto direction :
       {SineDirection::z_only, SineDirection::unit_normal, SineDirection::gradient}) {
    const SineScene scene(towards(direction));
    for (const double x : {0.0, 3.0, 12.5, 20.0}) {
      const Vec3 place{x, 4.0, scene.height_mm(x, 4.0) - 1e-3};
      const Vec3 normal = normalized(scene.normal_at(x, 4.0));
      expect_stiffness_is_the_slope(scene, place, normal, 1e-3);
    }
  }
}

TEST(Equation3_19to3_22, IsFiniteForAnyFinitePlace) {
  for (const auto direction :
       {SineDirection::z_only, SineDirection::unit_normal, SineDirection::gradient}) {
    SineOptions options = towards(direction);
    options.damping_n_s_per_m = 10.0;
    SineScene scene(options);
    expect_finite_everywhere(scene);
  }
}

TEST(Section3_6_4, NearestNormalIsOffByADegree) {
  const DirectionError error = table_error(SineDirection::table_nearest, 1.0);
  EXPECT_NEAR(error.rms, 1.19, 0.2 * 1.19);
  EXPECT_NEAR(error.most, 3.1, 0.2 * 3.1);
  RecordProperty("rms", std::to_string(error.rms));
  RecordProperty("most", std::to_string(error.most));
}

TEST(Section3_6_4, BilinearNormalIsOffByATenthOfADegree) {
  const DirectionError error = table_error(SineDirection::table_bilinear, 1.0);
  EXPECT_NEAR(error.most, 0.10, 0.02);
  RecordProperty("rms", std::to_string(error.rms));
  RecordProperty("most", std::to_string(error.most));
}

TEST(Section3_6_4, NearestIsOfFirstOrderAndBilinearOfSecond) {
  const auto order = [](SineDirection direction) {
    return std::log2(table_error(direction, 2.0).rms / table_error(direction, 0.5).rms) / 2.0;
  };
  const double nearest = order(SineDirection::table_nearest);
  const double bilinear = order(SineDirection::table_bilinear);
  EXPECT_NEAR(nearest, 1.0, 0.05);
  EXPECT_NEAR(bilinear, 2.0, 0.05);
  RecordProperty("nearest", std::to_string(nearest));
  RecordProperty("bilinear", std::to_string(bilinear));
}

/// The error of differences at many places, in degrees rms.
double difference_error(SineDirection direction, double step_mm) {
  SineOptions options = towards(direction);
  options.difference_step_mm = step_mm;
  return direction_error(options).rms;
}

TEST(Section3_6_4, DifferencesAheadAreOfFirstOrderAndCentralOnesOfSecond) {
  const auto order = [](SineDirection direction) {
    return std::log2(difference_error(direction, 2.0) / difference_error(direction, 0.5)) / 2.0;
  };
  const double ahead = order(SineDirection::differences_ahead);
  const double central = order(SineDirection::differences_central);
  EXPECT_NEAR(ahead, 1.0, 0.05);
  EXPECT_NEAR(central, 2.0, 0.05);
  RecordProperty("ahead", std::to_string(ahead));
  RecordProperty("central", std::to_string(central));
}

TEST(Section3_6_4, DifferencesOfATenthOfAMillimetreAreAsExactAsTheHeaderSays) {
  SineOptions options = towards(SineDirection::differences_ahead);
  const double ahead = direction_error(options).most;
  options.direction = SineDirection::differences_central;
  const double central = direction_error(options).most;
  EXPECT_LE(ahead, 0.33);
  EXPECT_LE(central, 0.0002);
  RecordProperty("ahead", std::to_string(ahead));
  RecordProperty("central", std::to_string(central));
}

/// Rounding: the smaller the step, the larger its share.
TEST(Section3_6_4, DifferencesOfTinyStepsAreWorse) {
  EXPECT_GT(difference_error(SineDirection::differences_central, 1e-12),
            100.0 * difference_error(SineDirection::differences_central, 1e-4));
}

TEST(Section3_6_4, TablesHoldUnitNormalsAndCoverTheirSquare) {
  for (const auto direction : {SineDirection::table_nearest, SineDirection::table_bilinear}) {
    SineOptions options = towards(direction);
    options.table_half_width_mm = 30.3;
    const SineScene scene(options);
    for (const double x : {-30.3, -7.0, 0.0, 30.3}) {
      EXPECT_NEAR(length(scene.direction_at(x, 30.3)), 1.0, 1e-12);
    }
    // A place of the table, and beyond it the normal itself.
    expect_near(scene.direction_at(7, -9), normalized(scene.normal_at(7, -9)), 1e-12);
    expect_near(scene.direction_at(44.4, 3.3), normalized(scene.normal_at(44.4, 3.3)), 1e-15);
    expect_near(scene.direction_at(3.3, -1e9), normalized(scene.normal_at(3.3, -1e9)), 1e-15);
  }
}

TEST(Section3_6_4, IsFiniteForAnyFinitePlace) {
  for (const auto direction :
       {SineDirection::table_nearest, SineDirection::table_bilinear,
        SineDirection::differences_ahead, SineDirection::differences_central}) {
    SineOptions options = towards(direction);
    options.damping_n_s_per_m = 10.0;
    SineScene scene(options);
    expect_finite_everywhere(scene);
  }
}

}  // namespace
}  // namespace argil::haptics
