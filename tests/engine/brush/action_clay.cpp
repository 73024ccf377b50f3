// SPDX-License-Identifier: GPL-3.0-or-later
// clay and clay_strips, on a slab whose top is at z = 0.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"

#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kClaySlabVoxel = 0.25;
constexpr double kClayRadius = 4.0;

/// Ripples of this height, or level.
Clay slab_of(double ripple_mm) {
  Box3 box;
  box.include({-16, -16, -6});
  box.include({16, 16, 3});
  const auto distance = [ripple_mm](const Vec3& p) {
    const double side = std::max({std::abs(p.x) - 15.0, std::abs(p.y) - 15.0, -5.0 - p.z});
    const double fades = std::clamp(13.0 - std::max(std::abs(p.x), std::abs(p.y)), 0.0, 1.0);
    const double top = p.z - fades * ripple_mm * std::sin(1.9 * p.x) * std::sin(1.9 * p.y);
    return std::max(side, top);
  };
  return Clay::from_distance(distance, box, ClayOptions{.voxel_mm = kClaySlabVoxel}).value();
}

double top_of(const Clay& clay, double x, double y) {
  const auto hit = pick(clay, Ray{{x, y, 50.0}, {0, 0, -1}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z : std::nan("");
}

struct RiseRange {
  double least = 1e9;
  double most = -1e9;
};

RiseRange rises_between(const Clay& before, const Clay& after) {
  RiseRange range;
  for (double x = -9.0; x <= 9.0; x += 0.53) {
    for (double y = -6.0; y <= 6.0; y += 0.53) {
      const double rise = top_of(after, x, y) - top_of(before, x, y);
      range.least = std::min(range.least, rise);
      range.most = std::max(range.most, rise);
    }
  }
  return range;
}

class ActionClay : public testing::TestWithParam<Action> {};

TEST_P(ActionClay, OnlyRaisesAndWithNegativeStrengthsOnlyLowers) {
  for (const double ripple : {0.0, 0.4}) {
    for (const double strength : {1.0, -1.0, 0.3}) {
      const Clay before = slab_of(ripple);
      Clay after = slab_of(ripple);
      const Stroke stroke = stroke_of(GetParam(), kClayRadius, strength, {{-4, 0, 0}, {4, 1, 0}});
      ASSERT_TRUE(after.apply(stroke).ok());
      const RiseRange rise = rises_between(before, after);
      const double side = strength < 0.0 ? -1.0 : 1.0;
      const double against = side > 0.0 ? -rise.least : rise.most;
      const double along = side > 0.0 ? rise.most : -rise.least;
      EXPECT_LT(against, 0.1 * kClaySlabVoxel) << "ripple " << ripple << ", strength " << strength;
      EXPECT_GT(along, 0.02 * kClayRadius) << "ripple " << ripple << ", strength " << strength;
      EXPECT_THAT(after.validate(), IsEmpty());
    }
  }
}

/// What is laid on fills the hollows first: ripples wear down as the clay rises.
TEST_P(ActionClay, LevelsWhatItCovers) {
  Clay clay = slab_of(0.4);
  Stroke stroke = stroke_of(GetParam(), kClayRadius, 0.7, {{-6, 0, 0}, {6, 0, 0}, {-6, 0, 0}});
  const auto roughness = [](const Clay& now) {
    double most = -1e9;
    double least = 1e9;
    for (double x = -3.0; x <= 3.0; x += 0.2) {
      most = std::max(most, top_of(now, x, 0.4));
      least = std::min(least, top_of(now, x, 0.4));
    }
    return most - least;
  };
  const double before = roughness(clay);
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_LT(roughness(clay), 0.25 * before);
}

/// The offset moves the plane: with one a radius below nothing is laid on.
TEST_P(ActionClay, TakesThePlaneFromItsOffset) {
  const Clay before = slab_of(0.0);
  std::vector<double> rises;
  for (const double offset : {-1.0, 0.0, 0.2}) {
    Clay after = slab_of(0.0);
    Stroke stroke = stroke_of(GetParam(), kClayRadius, 1.0, {{0, 0, 0}});
    stroke.tool.plane_offset = offset;
    ASSERT_TRUE(after.apply(stroke).ok());
    rises.push_back(top_of(after, 0, 0) - top_of(before, 0, 0));
  }
  EXPECT_NEAR(rises[0], 0.0, 0.01 * kClaySlabVoxel);
  const double raise = GetParam() == Action::clay ? 1.0 / 16.0 : 1.0 / 32.0;
  EXPECT_NEAR(rises[1], raise * kClayRadius, 0.2 * kClaySlabVoxel);
  EXPECT_NEAR(rises[2], (raise + 0.2) * kClayRadius, 0.3 * kClaySlabVoxel);
}

/// A stroke lays on as much however close its dabs lie.
TEST_P(ActionClay, HardlyDependsOnItsSpacing) {
  const Clay before = slab_of(0.0);
  std::vector<double> rises;
  for (const double spacing : {0.05, 0.25, 0.5}) {
    Clay after = slab_of(0.0);
    Stroke stroke = stroke_of(GetParam(), kClayRadius, 1.0, {{-8, 0, 0}, {8, 0, 0}});
    stroke.spacing = spacing;
    ASSERT_TRUE(after.apply(stroke).ok());
    rises.push_back(top_of(after, 0, 0) - top_of(before, 0, 0));
    std::printf("spacing %g: %.3f mm\n", spacing, rises.back());
  }
  for (const double rise : rises) EXPECT_NEAR(rise, rises[1], 0.25 * rises[1]);
}

INSTANTIATE_TEST_SUITE_P(Actions, ActionClay, testing::Values(Action::clay, Action::clay_strips));

/// Level across to its sides along a stroke in any direction, and nothing beside it.
TEST(ActionClayStrips, LaysASquareStripAlongTheStroke) {
  for (const double angle : {0.0, 0.5, 2.2}) {
    const Vec3 along{std::cos(angle), std::sin(angle), 0.0};
    const Vec3 across{-along.y, along.x, 0.0};
    Clay clay = slab_of(0.0);
    ASSERT_TRUE(
        clay.apply(stroke_of(Action::clay_strips, kClayRadius, 1.0, {-5.0 * along, 5.0 * along}))
            .ok());
    const auto rise = [&](double beside) {
      return top_of(clay, beside * kClayRadius * across.x, beside * kClayRadius * across.y);
    };
    ASSERT_GT(rise(0.0), 0.1 * kClayRadius);
    for (const double beside : {-0.8, -0.5, 0.5, 0.8}) {
      EXPECT_NEAR(rise(beside) / rise(0.0), 1.0, 0.1) << angle << " at " << beside;
    }
    EXPECT_NEAR(rise(1.1), 0.0, 0.1 * kClaySlabVoxel) << angle;
    EXPECT_NEAR(rise(-1.1), 0.0, 0.1 * kClaySlabVoxel) << angle;
    EXPECT_THAT(clay.validate(), IsEmpty());
  }
}

/// Its corners are as far out as a square's, those of a round tip are not.
TEST(ActionClayStrips, HasTheCornersThatItsRoundnessLeaves) {
  for (const double roundness : {0.18, 1.0}) {
    Clay clay = slab_of(0.0);
    Stroke dab = stroke_of(Action::clay_strips, kClayRadius, 1.0, {{0, 0, 0}});
    dab.tool.tip_roundness = roundness;
    dab.tool.plane_offset = 0.1;
    ASSERT_TRUE(clay.apply(dab).ok());
    const double corner = top_of(clay, 0.72 * kClayRadius, 0.78 * kClayRadius);
    const double middle = top_of(clay, 0.0, 0.0);
    ASSERT_GT(middle, 0.1 * kClayRadius);
    if (roundness < 1.0) {
      EXPECT_GT(corner, 0.5 * middle);
    } else {
      EXPECT_NEAR(corner, 0.0, 0.01 * kClaySlabVoxel);
    }
  }
}

}  // namespace
}  // namespace argil
