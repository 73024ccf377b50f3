// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/vec3.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace argil {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Vec3, ComputesByComponent) {
  const Vec3 a{1, 2, 3};
  const Vec3 b{-4, 5, 0.5};
  EXPECT_EQ(a + b, (Vec3{-3, 7, 3.5}));
  EXPECT_EQ(a - b, (Vec3{5, -3, 2.5}));
  EXPECT_EQ(-a, (Vec3{-1, -2, -3}));
  EXPECT_EQ(2.0 * a, a * 2.0);
  EXPECT_EQ(b / 2.0, (Vec3{-2, 2.5, 0.25}));
  EXPECT_EQ(dot(a, b), 7.5);
}

TEST(Vec3, IndexesItsAxes) {
  Vec3 a{1, 2, 3};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(a[axis], static_cast<double>(axis + 1));
    a[axis] = 9.0;
  }
  EXPECT_EQ(a, (Vec3{9, 9, 9}));
}

TEST(Vec3, CrossesRightHanded) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  const Vec3 a{1, 2, 3};
  const Vec3 b{-4, 5, 0.5};
  EXPECT_EQ(dot(cross(a, b), a), 0.0);
  EXPECT_EQ(cross(a, b), -cross(b, a));
}

TEST(Vec3, NormalizesZeroToZero) {
  EXPECT_EQ(normalized(Vec3{}), Vec3{});
  EXPECT_NEAR(length(normalized(Vec3{3, -4, 12})), 1.0, 1e-15);
}

TEST(Vec3, TellsWhatIsNotFinite) {
  EXPECT_TRUE(is_finite(Vec3{1, 2, 3}));
  EXPECT_FALSE(is_finite(Vec3{1, std::numeric_limits<double>::quiet_NaN(), 3}));
  EXPECT_FALSE(is_finite(Vec3{1, 2, -std::numeric_limits<double>::infinity()}));
}

TEST(Quat, RotatesByTheRightHandRule) {
  const double half = std::numbers::pi / 4.0;
  const Quat quarter_about_z{std::cos(half), 0, 0, std::sin(half)};
  expect_near(rotate(quarter_about_z, {1, 0, 0}), {0, 1, 0}, 1e-15);
  expect_near(rotate(quarter_about_z, {0, 0, 5}), {0, 0, 5}, 1e-15);
}

TEST(Quat, IsUndoneByItsConjugate) {
  const Quat q = normalized(Quat{0.3, -1.2, 0.7, 2.0});
  const Vec3 v{1.5, -2.5, 0.25};
  expect_near(rotate(conjugate(q), rotate(q, v)), v, 1e-14);
  EXPECT_NEAR(length(rotate(q, v)), length(v), 1e-14);
}

TEST(Quat, NormalizesZeroToTheIdentity) { EXPECT_EQ(normalized(Quat{0, 0, 0, 0}), Quat{}); }

TEST(Box3, IsEmptyUntilItIncludesAPoint) {
  Box3 box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.size(), Vec3{});
  box.include({-7, 8, 9});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.size(), Vec3{});
  EXPECT_EQ(box.center(), (Vec3{-7, 8, 9}));
}

TEST(Box3, MeetsWhatComesWithinTheMargin) {
  const Box3 box{{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
  EXPECT_TRUE(box.meets(box));
  EXPECT_TRUE(box.meets({{1.0, 2.0, 3.0}, {4.0, 4.0, 4.0}}));  // in a corner
  EXPECT_TRUE(box.meets({{0.5, 0.5, 0.5}, {0.6, 0.6, 0.6}}));  // within
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Box3 beyond = box;
    beyond.min[axis] += box.max[axis] + 0.5;
    beyond.max[axis] += box.max[axis] + 0.5;
    EXPECT_FALSE(box.meets(beyond)) << axis;
    EXPECT_FALSE(beyond.meets(box)) << axis;
    EXPECT_TRUE(box.meets(beyond, 0.5)) << axis;
    EXPECT_TRUE(beyond.meets(box, 0.5)) << axis;
  }
}

TEST(Box3, GrowsToWhatItIncludes) {
  Box3 box;
  for (const Vec3& p : {Vec3{1, 1, 1}, Vec3{-1, 4, 0}, Vec3{0, 2, 3}}) box.include(p);
  EXPECT_EQ(box.min, (Vec3{-1, 1, 0}));
  EXPECT_EQ(box.max, (Vec3{1, 4, 3}));
  EXPECT_EQ(box.size(), (Vec3{2, 3, 3}));
}

}  // namespace
}  // namespace argil
