// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "math/mat3.h"

namespace argil::haptics {
namespace {

// Checks of the equations in docs/theory.md, "Falcon", and vectors worked out with them.

struct Set {
  const char* name;
  FalconKinematics kinematics;
};

std::vector<Set> sets() {
  return {{"libnifalcon", FalconKinematics(libnifalcon_geometry())},
          {"Martin and Hillier", FalconKinematics(martin_hillier_geometry())}};
}

constexpr double kArmMm = 60.0;  // of both sets
constexpr Vec3 kColdStart{0.0, 0.0, 120.0};

double most_ticks(const FalconKinematics& kinematics, const LegValues& angles) {
  double most = 0.0;
  for (const double t : kinematics.ticks_of_angles(angles)) most = std::max(most, std::abs(t));
  return most;
}

/// How much of a box the three rods' directions span: 1 when square to each other, 0 singular.
double openness(const std::array<Vec3, 3>& rates) {
  return std::abs(determinant(Mat3{rates})) /
         (length(rates[0]) * length(rates[1]) * length(rates[2]));
}

/// How much faster the fastest arm turns than it would if the handle hung on its knee: grows
/// without bounds where an arm is in line with its rod.
double fastest(const std::array<Vec3, 3>& rates) {
  return kArmMm * std::max({length(rates[0]), length(rates[1]), length(rates[2])});
}

/// J by columns, millimetres per radian: the inverse of B.
std::array<Vec3, 3> inverse(const std::array<Vec3, 3>& b) {
  const double scale = 1.0 / determinant(Mat3{b});
  return {scale * cross(b[1], b[2]), scale * cross(b[2], b[0]), scale * cross(b[0], b[1])};
}

struct Pose {
  Vec3 position_mm;
  LegValues angles_rad;
  std::array<Vec3, 3> rates;
};

/// A random pose with |ticks| <= 1700 that is not close to a singularity.
class Poses {
 public:
  Pose next(const FalconKinematics& kinematics) {
    for (;;) {
      const Vec3 p = place();
      const auto angles = kinematics.angles_of(p);
      if (!angles || most_ticks(kinematics, *angles) > 1700.0) continue;
      const auto rates = kinematics.rates_of(p);
      if (rates && openness(*rates) >= 0.1 && fastest(*rates) <= 4.0) return {p, *angles, *rates};
    }
  }
  Vec3 place() { return {side_(random_), side_(random_), height_(random_)}; }
  Vec3 direction() { return normalized(Vec3{some_(random_), some_(random_), some_(random_)}); }

 private:
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> side_{-110.0, 110.0};
  std::uniform_real_distribution<double> height_{35.0, 195.0};
  std::normal_distribution<double> some_{0.0, 1.0};
};

constexpr int kPoses = 20000;

struct Vector {
  LegValues ticks;
  Vec3 position_m;
  LegValues words;  ///< for (1, -2, 0.5) N
};

void expect_vectors(const FalconKinematics& kinematics, const std::vector<Vector>& vectors) {
  for (const Vector& v : vectors) {
    const auto place = kinematics.position_of(kinematics.angles_of_ticks(v.ticks), kColdStart);
    EXPECT_TRUE(place.is_converged);
    const auto words = kinematics.motor_words({1.0, -2.0, 0.5}, place.position_mm);
    EXPECT_EQ(words.scale, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(place.position_mm[i] / 1000.0, v.position_m[i], 0.51e-9);
      EXPECT_NEAR(words.exact[i], v.words[i], 0.51e-3);
      EXPECT_EQ(words.word[i], std::lround(v.words[i]));
    }
  }
}

TEST(FalconKinematics, MatchesTheVectorsOfLibnifalcon) {
  expect_vectors(
      FalconKinematics(libnifalcon_geometry()),
      {{{0, 0, 0}, {0, 0, 0.134602428}, {-1597.678, 831.672, 391.930}},
       {{500, -200, 300}, {0.022822801, -0.014027427, 0.140612225}, {-1747.720, 653.914, 560.301}},
       {{-400, 600, -100},
        {-0.035112717, 0.017960955, 0.128849373},
        {-1387.964, 1131.130, 272.408}},
       {{200, -800, 900},
        {0.057565233, 0.020125654, 0.120664976},
        {-1509.097, 301.474, 1066.098}}});
}

TEST(FalconKinematics, MatchesTheVectorsOfMartinAndHillier) {
  expect_vectors(
      FalconKinematics(martin_hillier_geometry()),
      {{{0, 0, 0}, {0, 0, 0.144767113}, {-1151.137, 667.463, 251.297}},
       {{500, -200, 300}, {0.024212790, -0.017313883, 0.149570754}, {-1260.035, 541.152, 393.346}},
       {{200, -800, 900}, {0.064291563, 0.020931656, 0.126856461}, {-1118.094, 218.824, 863.694}}});
}

TEST(FalconKinematics, PositionOfAnglesIsInverse) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    double worst_mm = 0.0;
    double worst_rad = 0.0;
    int wrong = 0;
    for (int n = 0; n < 100'000; ++n) {
      const Pose pose = poses.next(set.kinematics);
      const auto place = set.kinematics.position_of(pose.angles_rad, kColdStart);
      wrong += place.is_converged ? 0 : 1;
      worst_mm = std::max(worst_mm, length(place.position_mm - pose.position_mm));
      const auto angles = set.kinematics.angles_of(place.position_mm);
      ASSERT_TRUE(angles);
      for (std::size_t i = 0; i < 3; ++i) {
        worst_rad = std::max(worst_rad, std::abs((*angles)[i] - pose.angles_rad[i]));
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(worst_mm, 1e-9);
    EXPECT_LE(worst_rad, 1e-12);
  }
}

TEST(FalconKinematics, NeverConvergesToAWrongPlace) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    int tried = 0;
    int unsaid = 0;
    for (int n = 0; n < 100000; ++n) {  // singular positions included
      const Vec3 p = poses.place();
      const auto angles = set.kinematics.angles_of(p);
      if (!angles || most_ticks(set.kinematics, *angles) > 1700.0) continue;
      const auto place = set.kinematics.position_of(*angles, kColdStart);
      tried += place.is_converged ? 1 : 0;
      unsaid += place.is_converged && length(place.position_mm - p) > 1e-6 ? 1 : 0;
    }
    EXPECT_EQ(unsaid, 0);
    EXPECT_GT(tried, 10000);
  }
}

TEST(FalconKinematics, ConvergesInFewSteps) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    int cold = 0;
    int most_cold = 0;
    int near = 0;
    int most_near = 0;
    for (int n = 0; n < kPoses; ++n) {
      const Pose pose = poses.next(set.kinematics);
      const int steps = set.kinematics.position_of(pose.angles_rad, kColdStart).steps;
      cold += steps;
      most_cold = std::max(most_cold, steps);
      const Vec3 start = pose.position_mm + 1.4 * poses.direction();
      const auto place = set.kinematics.position_of(pose.angles_rad, start);
      ASSERT_TRUE(place.is_converged);
      near += place.steps;
      most_near = std::max(most_near, place.steps);
    }
    EXPECT_LE(cold, 8 * kPoses);
    EXPECT_LE(most_cold, 12);
    EXPECT_NEAR(near, 4 * kPoses, 0.02 * kPoses);
    EXPECT_LE(most_near, 5);
  }
}

/// Derivative along one coordinate by differences of fourth order.
template <class Function>
auto derivative(const Function& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

/// A row of B by differences.
Vec3 rate_by_differences(const FalconKinematics& kinematics, const Pose& pose, std::size_t leg) {
  Vec3 row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto angle = [&](double h) {
      Vec3 p = pose.position_mm;
      p[axis] += h;
      return kinematics.angles_of(p).value()[leg];
    };
    row[axis] = derivative(angle, 0.01);
  }
  return row;
}

TEST(FalconKinematics, RatesAreTheDerivativesOfTheAngles) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    double worst = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      const Pose pose = poses.next(set.kinematics);
      for (std::size_t leg = 0; leg < 3; ++leg) {
        const Vec3 off = rate_by_differences(set.kinematics, pose, leg) - pose.rates[leg];
        worst = std::max(worst, length(off) / length(pose.rates[leg]));
      }
    }
    EXPECT_LE(worst, 1e-8);
  }
}

/// A column of J by differences of the forward kinematics.
Vec3 column_by_differences(const FalconKinematics& kinematics, const Pose& pose, std::size_t leg) {
  const auto place = [&](double h) {
    LegValues angles = pose.angles_rad;
    angles[leg] += h;
    return kinematics.position_of(angles, pose.position_mm).position_mm;
  };
  return derivative(place, 3e-4);
}

TEST(FalconKinematics, InverseRatesAreTheDerivativesOfThePosition) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    double worst = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      const Pose pose = poses.next(set.kinematics);
      const std::array<Vec3, 3> j = inverse(pose.rates);
      for (std::size_t leg = 0; leg < 3; ++leg) {
        const Vec3 column = column_by_differences(set.kinematics, pose, leg);
        worst = std::max(worst, length(column - j[leg]));
      }
    }
    EXPECT_LE(worst, 2e-6);  // mm per rad
  }
}

TEST(FalconKinematics, IsRegularAndMovesByTensOfMicrometresPerTick) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    const LegValues angles = set.kinematics.angles_of_ticks({0.0, 1.0, 0.0});
    const double rad_per_tick = angles[1] - angles[0];
    Poses poses;
    double least = 1.0;
    double most = 0.0;
    double regular = 1.0;
    double fast = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      const Vec3 p =
          kFalconCenterMm + kFalconUsableRadiusMm * std::cbrt(n / 1.0 / kPoses) * poses.direction();
      const std::array<Vec3, 3> rates = set.kinematics.rates_of(p).value();
      regular = std::min(regular, openness(rates));
      fast = std::max(fast, fastest(rates));
      for (const Vec3& column : inverse(rates)) {
        least = std::min(least, rad_per_tick * length(column));
        most = std::max(most, rad_per_tick * length(column));
      }
    }
    EXPECT_GE(regular, 0.3);
    EXPECT_LE(fast, 1.5);
    EXPECT_GE(least, 0.024);
    EXPECT_LE(most, 0.060);
  }
}

/// Most ticks at the surface of a ball, or infinity where it is out of reach.
double most_ticks_on(const FalconKinematics& kinematics, const Vec3& center, double radius_mm) {
  Poses poses;
  double most = 0.0;
  for (int n = 0; n < kPoses; ++n) {
    const auto angles = kinematics.angles_of(center + radius_mm * poses.direction());
    if (!angles) return std::numeric_limits<double>::infinity();
    most = std::max(most, most_ticks(kinematics, *angles));
  }
  return most;
}

TEST(FalconKinematics, ReachesABallOf48Millimetres) {
  const FalconKinematics lib(libnifalcon_geometry());
  EXPECT_LE(most_ticks_on(lib, kFalconCenterMm, 48.0), 1600.0);
  EXPECT_GT(most_ticks_on(lib, kFalconCenterMm, 49.0), 1600.0);
  const FalconKinematics hillier(martin_hillier_geometry());
  EXPECT_LE(most_ticks_on(hillier, {0, 0, 135}, 47.4), 1600.0);
  EXPECT_GT(most_ticks_on(hillier, {0, 0, 135}, 48.0), 1600.0);
}

TEST(FalconKinematics, SaturatesAtTheForcesOfTheSources) {
  // Least force over all directions that the motors can just give at (0, 0, 125) mm.
  const std::array<double, 2> expected_n{6.1, 8.9};
  for (std::size_t s = 0; s < 2; ++s) {
    const Set set = sets()[s];
    Poses poses;
    double least = 1e9;
    for (int n = 0; n < kPoses; ++n) {
      const auto words = set.kinematics.motor_words(100.0 * poses.direction(), {0, 0, 125});
      least = std::min(least, 100.0 * words.scale);
    }
    EXPECT_NEAR(least, expected_n[s], 0.06) << set.name;
  }
}

TEST(FalconKinematics, KeepsTheDirectionOfAForceBeyondTheMotors) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    double worst = 0.0;
    double most = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      const Pose pose = poses.next(set.kinematics);
      const Vec3 force = 1e4 * poses.direction();
      const auto words = set.kinematics.motor_words(force, pose.position_mm);
      ASSERT_LT(words.scale, 1.0);
      Vec3 given;
      double largest = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        given += -words.exact[i] * pose.rates[i];
        largest = std::max(largest, std::abs(words.exact[i]));
        most = std::max(most, std::abs(words.word[i] / 1.0));
        ASSERT_LE(std::abs(words.word[i] - words.exact[i]), 0.5 + 1e-9);
      }
      ASSERT_NEAR(largest, kFalconLargestWord, 1e-9);
      worst = std::max(worst, length(normalized(given) - normalized(force)));
    }
    EXPECT_LE(worst, 1e-12);
    EXPECT_EQ(most, kFalconLargestWord);
  }
}

TEST(FalconKinematics, ForceTimesMotionIsTorqueTimesTurning) {
  const FalconGeometry geometry = martin_hillier_geometry();
  const FalconKinematics kinematics(geometry);
  Poses poses;
  for (int n = 0; n < 1000; ++n) {
    const Pose pose = poses.next(kinematics);
    const Vec3 force = poses.direction();
    const Vec3 motion = poses.direction();
    const auto words = kinematics.motor_words(force, pose.position_mm);
    double work_nmm = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double torque_nmm = -words.exact[i] / words.scale / geometry.words_per_nm * 1000.0;
      work_nmm += torque_nmm * dot(pose.rates[i], motion);
    }
    ASSERT_NEAR(work_nmm, dot(force, motion), 1e-12);
  }
}

TEST(FalconKinematics, GivesNoForceWhereItIsSingular) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    Poses poses;
    int singular = 0;
    for (int n = 0; n < 100000; ++n) {
      const Vec3 p = 1.3 * poses.place();
      const auto words = set.kinematics.motor_words(poses.direction(), p);
      ASSERT_EQ(words.is_singular, !set.kinematics.rates_of(p).has_value());
      if (words.is_singular) {
        ++singular;
        ASSERT_EQ(words.exact, LegValues{});
        ASSERT_EQ(words.word, (std::array<std::int16_t, 3>{}));
      }
    }
    EXPECT_GT(singular, 1000);
    // Arms in line with their rods.
    double reach = 130.0;
    while (set.kinematics.angles_of({0, 0, reach + 1e-6})) reach += 1e-4;
    EXPECT_TRUE(set.kinematics.motor_words({0, 0, 1}, {0, 0, reach}).is_singular);
  }
}

TEST(FalconKinematics, GivesNoForceForWhatIsNotANumber) {
  const FalconKinematics kinematics(libnifalcon_geometry());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 1e308}) {
    const auto words = kinematics.motor_words({0.0, bad, -bad}, kFalconCenterMm);
    EXPECT_EQ(words.word, (std::array<std::int16_t, 3>{}));
    EXPECT_EQ(words.exact, LegValues{});
    EXPECT_FALSE(kinematics.angles_of({0.0, bad, 130.0}));
    EXPECT_FALSE(kinematics.angles_of({0.0, 0.0, bad}));
    EXPECT_FALSE(kinematics.position_of({bad, 0.6, 0.6}, kFalconCenterMm).is_converged);
    EXPECT_TRUE(kinematics.position_of({0.6, 0.6, 0.6}, {bad, 0.0, 130.0}).is_converged);
  }
}

TEST(FalconKinematics, SaysWhatIsOutOfReach) {
  for (const Set& set : sets()) {
    EXPECT_FALSE(set.kinematics.angles_of({0, 0, 400})) << set.name;
    EXPECT_FALSE(set.kinematics.angles_of({200, 0, 130})) << set.name;
    // Arms straight out, no place for a platform.
    EXPECT_FALSE(set.kinematics.position_of({0.0, 3.1, 0.0}, kFalconCenterMm).is_converged);
  }
}

TEST(FalconKinematics, ConvertsTicksBothWays) {
  for (const Set& set : sets()) {
    const LegValues ticks{-1600.0, 3.0, 1234.5};
    const LegValues back = set.kinematics.ticks_of_angles(set.kinematics.angles_of_ticks(ticks));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], ticks[i], 1e-9) << set.name;
  }
  // Degrees per tick of the fact sheet.
  const auto step_deg = [](const FalconGeometry& g) {
    const FalconKinematics k(g);
    return (k.angles_of_ticks({1, 0, 0})[0] - k.angles_of_ticks({0, 0, 0})[0]) * 180.0 / 3.14159265;
  };
  EXPECT_NEAR(step_deg(libnifalcon_geometry()), 0.036435, 1e-6);
  EXPECT_NEAR(step_deg(martin_hillier_geometry()), 0.036909, 1e-6);
}

}  // namespace
}  // namespace argil::haptics
