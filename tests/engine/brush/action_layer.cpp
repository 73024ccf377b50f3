// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"

#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kLayerVoxel = 0.25;
constexpr double kSlabHalf = 10.0;  // of the slab's thickness, and the ball's radius
constexpr double kLayerRadius = 4.0;
constexpr double kLayerRise = kLayerRadius / 4.0;

Clay layer_slab() {
  return Clay::block({40, 40, 2 * kSlabHalf}, ClayOptions{.voxel_mm = kLayerVoxel}).value();
}
Clay layer_ball() { return Clay::ball(kSlabHalf, ClayOptions{.voxel_mm = kLayerVoxel}).value(); }

/// How far out the clay reaches along a direction from its middle, beside `at`.
double reach_of(const Clay& clay, const Vec3& at, const Vec3& along) {
  const auto hit = pick(clay, Ray{at + 100.0 * along, -along});
  return hit.ok() && hit.value() ? dot(hit.value()->point_mm - at, along) : std::nan("");
}

double slab_rise(const Clay& clay, double x, double y) {
  return reach_of(clay, {x, y, 0}, {0, 0, 1}) - kSlabHalf;
}

Vec3 around(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

Stroke layer_stroke(double strength, const std::vector<Vec3>& places) {
  return stroke_of(Action::layer, kLayerRadius, strength, places);
}

TEST(ActionLayer, ReachesItsHeightOnAPlaneHoweverOftenItPasses) {
  for (const double strength : {1.0, 0.4, -1.0}) {
    const double height = strength * kLayerRise;
    for (const int passes : {1, 4}) {
      std::vector<Vec3> places;
      for (int n = 0; n <= passes; ++n) places.push_back({n % 2 == 0 ? -6.0 : 6.0, 0, kSlabHalf});
      Clay clay = layer_slab();
      ASSERT_TRUE(clay.apply(layer_stroke(strength, places)).ok());
      for (double x = -6.0; x <= 6.0; x += 0.37) {
        EXPECT_NEAR(slab_rise(clay, x, 0), height, 0.25 * kLayerVoxel) << strength << " at " << x;
        for (double y = 0.4; y < 6.0; y += 0.4) {
          const double rise = slab_rise(clay, x, y) / height;
          EXPECT_GT(rise, -0.25 * kLayerVoxel / kLayerRise) << strength << " at " << x << ' ' << y;
          EXPECT_LT(rise, 1.0 + 0.25 * kLayerVoxel / std::abs(height))
              << strength << " at " << x << ' ' << y;
        }
      }
      EXPECT_NEAR(slab_rise(clay, 0, 5.0), 0.0, 0.1 * kLayerVoxel);  // beyond the tool
      EXPECT_THAT(clay.validate(), IsEmpty());
    }
  }
}

TEST(ActionLayer, ReachesItsHeightOnABallHoweverOftenItPasses) {
  for (const double strength : {1.0, -1.0}) {
    std::vector<Vec3> places;
    for (const double end : {-0.6, 0.6, -0.6, 0.6}) {
      for (double n = -0.9; n <= 1.0; n += 0.1)
        places.push_back(kSlabHalf * around(n * std::abs(end) * (end > 0 ? 1.0 : -1.0)));
    }
    Clay clay = layer_ball();
    ASSERT_TRUE(clay.apply(layer_stroke(strength, places)).ok());
    for (double angle = -0.5; angle <= 0.5; angle += 0.03) {
      EXPECT_NEAR(reach_of(clay, {}, around(angle)), kSlabHalf + strength * kLayerRise,
                  0.25 * kLayerVoxel)
          << strength << " at " << angle;
    }
    EXPECT_THAT(clay.validate(), IsEmpty());
  }
}

/// A cross within one stroke is as high as its arms.
TEST(ActionLayer, DoesNotAddUpWhereAStrokeCrossesItself) {
  Clay clay = layer_slab();
  const std::uint64_t start = clay.hash();
  ASSERT_TRUE(clay.apply(layer_stroke(1.0, {{-6, 0, kSlabHalf},
                                            {6, 0, kSlabHalf},
                                            {6, 6, kSlabHalf},
                                            {0, 6, kSlabHalf},
                                            {0, -6, kSlabHalf}}))
                  .ok());
  for (double y = -5.5; y <= 5.5; y += 0.3) {
    EXPECT_NEAR(slab_rise(clay, 0, y), kLayerRise, 0.25 * kLayerVoxel) << y;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
  // Another stroke lays the next on it.
  ASSERT_TRUE(clay.apply(layer_stroke(1.0, {{-6, 0, kSlabHalf + kLayerRise},
                                            {6, 0, kSlabHalf + kLayerRise}}))
                  .ok());
  EXPECT_NEAR(slab_rise(clay, -3, 0), 2.0 * kLayerRise, 0.5 * kLayerVoxel);
  ASSERT_TRUE(clay.undo());
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
}

/// As level with two radii between its dabs as with a twentieth.
TEST(ActionLayer, IsLevelHoweverFarApartItsDabsLie) {
  for (const double spacing : {0.05, 2.0}) {
    Stroke stroke = layer_stroke(1.0, {{-6, 0, kSlabHalf}, {6, 0, kSlabHalf}});
    stroke.spacing = spacing;
    Clay clay = layer_slab();
    ASSERT_TRUE(clay.apply(stroke).ok());
    for (double x = -6.0; x <= 6.0; x += 0.37) {
      EXPECT_NEAR(slab_rise(clay, x, 0), kLayerRise, 0.25 * kLayerVoxel) << spacing << " at " << x;
    }
  }
}

/// What is wide against the height goes up with the surface: it neither grows nor wears down. A
/// groove narrower than the height closes, since the surface moves along its own normal.
TEST(ActionLayer, CarriesDetail) {
  constexpr double kGrooveRadius = 3.0;
  constexpr double kGrooveDepth = 0.5;
  const double above = kSlabHalf + kGrooveRadius - kGrooveDepth;
  Clay clay = layer_slab();
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::carve, kGrooveRadius, 1.0, {{-9, 0, above}, {9, 0, above}}))
          .ok());
  const double depth = slab_rise(clay, 0, 0);
  ASSERT_NEAR(depth, -kGrooveDepth, 0.2 * kLayerVoxel);
  ASSERT_TRUE(
      clay.apply(layer_stroke(1.0, {{0, -6, kSlabHalf}, {0, 6, kSlabHalf}, {0, -6, kSlabHalf}}))
          .ok());
  EXPECT_NEAR(slab_rise(clay, 0, 0), depth + kLayerRise, 0.35 * kLayerVoxel);
  EXPECT_NEAR(slab_rise(clay, 0, 3), kLayerRise, 0.25 * kLayerVoxel);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(ActionLayerGolden, GivesTheSameBitsForAnyThreadCountAndInPieces) {
  Stroke stroke = layer_stroke(0.8, {{9, -3, 0}, {10, 0, 1}, {9, 3, 2}, {9, -3, 1}});
  stroke.mirror.x = true;
  stroke.radial = {2, 2};
  std::vector<std::uint64_t> hashes;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Clay whole = layer_ball();
    ASSERT_TRUE(whole.apply(stroke).ok());
    hashes.push_back(whole.hash());
    Clay pieces = layer_ball();
    ASSERT_TRUE(pieces.begin_stroke(stroke.tool, stroke).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(pieces.extend_stroke({&sample, 1}).ok());
    }
    ASSERT_TRUE(pieces.end_stroke().ok());
    hashes.push_back(pieces.hash());
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

TEST(ActionLayer, IsHalfAsHighWhereClayIsHalfMasked) {
  Clay clay = layer_ball();
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 30.0, 0.5, {{kSlabHalf, 0, 0}})).ok());
  ASSERT_TRUE(clay.apply(layer_stroke(1.0, {{kSlabHalf, 0, 0}})).ok());
  EXPECT_NEAR(reach_of(clay, {}, {1, 0, 0}), kSlabHalf + 0.5 * kLayerRise, 0.25 * kLayerVoxel);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

}  // namespace
}  // namespace argil
