// SPDX-License-Identifier: GPL-3.0-or-later
// Creases and ridges: their shape on the surface that is drawn, and what a stroke must not depend
// on.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "measure/crease_shape.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kCreaseVoxel = 0.25;
constexpr double kCreaseBall = 40.0;

// ---- The shape ----------------------------------------------------------------------------------

/// Of a tool of 8 voxels at a level, along a great circle that no axis lies in: lattices show most.
evaluation::CreaseLine crease_line(double tool_mm, double side) {
  const Vec3 normal = normalized(Vec3{0.45, 0.25, 0.86});
  const Vec3 toward{0.1, -0.97, 0.23};
  const Vec3 middle = normalized(toward - dot(toward, normal) * normal);
  return {kCreaseBall, normal, middle, 0.55 - tool_mm / kCreaseBall - 0.05, tool_mm, side};
}

Stroke along_line(const evaluation::CreaseLine& line, Action action, bool is_back) {
  const Vec3 across = cross(line.normal, line.middle);
  std::vector<Vec3> places;
  for (int n = 0; n <= 120; ++n) {
    const double angle = 0.55 * (n / 60.0 - 1.0) * (is_back ? -1.0 : 1.0);
    places.push_back(line.ball_mm * (std::cos(angle) * line.middle + std::sin(angle) * across));
  }
  return stroke_of(action, line.tool_mm, 1.0, places);
}

evaluation::CreaseShape shape_after(int strokes, int level, Action action) {
  const double tool_mm = 8.0 * kCreaseVoxel * (1 << level);
  const evaluation::CreaseLine line = crease_line(tool_mm, action == Action::ridge ? -1.0 : 1.0);
  Clay clay = Clay::ball(kCreaseBall, ClayOptions{.voxel_mm = kCreaseVoxel}).value();
  for (int n = 0; n < strokes; ++n) {
    EXPECT_TRUE(clay.apply(along_line(line, action, n % 2 == 1)).ok());
  }
  const evaluation::CreaseShape shape = evaluation::crease_shape(extract_surface(clay), line);
  const double h = tool_mm / 8.0;
  std::printf(
      "%s, level %d, strokes %d: %.2f h deep, depth/width %.3f, sharpness %.3f, bottom "
      "%.4f h\n",
      info_of(action).name, level, strokes, shape.depth_mm / h, shape.depth_mm / shape.width_mm,
      shape.sharpness, shape.bottom_rms_mm / h);
  return shape;
}

/// Not a step short of it: the last piece has pressure where it begins.
TEST(Crease, RunsOutWherePressureEnds) {
  constexpr double kBall = 20.0;
  constexpr double kTool = 3.0;
  Stroke stroke =
      stroke_of(Action::crease, kTool, 1.0, {{kBall, -3, 0}, {kBall, 0, 0}, {kBall, 1.5, 0}});
  stroke.spacing = 0.5;  // a piece ends where the pressure begins to fall
  stroke.samples.back().pressure = 0.0;
  Clay clay = Clay::ball(kBall, ClayOptions{.voxel_mm = kCreaseVoxel}).value();
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (const double y : {0.3, 0.75, 1.1}) {
    const double depth = clay.distance_at({std::sqrt(kBall * kBall - y * y), y, 0.0});
    const double pressure = 1.0 - y / 1.5;
    EXPECT_NEAR(depth, 0.25 * kTool * pressure, 0.6 * kCreaseVoxel) << y;
    EXPECT_GT(depth, 0.1 * kCreaseVoxel) << y;
  }
}

class CreaseShapeOf : public testing::TestWithParam<Action> {};

/// At level 0 there is no finer leaf for the line: the point is as round as the tool's own voxels
/// make it. A ridge is a little less even than a crease.
TEST_P(CreaseShapeOf, IsDeepSharpAndEvenAtEveryLevel) {
  for (const int level : {0, 1, 2}) {
    const double h = kCreaseVoxel * (1 << level);
    const evaluation::CreaseShape shape = shape_after(1, level, GetParam());
    const double finer = GetParam() == Action::ridge ? 0.017 : 0.015;
    const double bottom_h = level == 0 ? 0.034 : finer;
    EXPECT_NEAR(shape.depth_mm, 2.0 * h, 0.1 * h) << level;
    EXPECT_GE(shape.depth_mm / shape.width_mm, 0.5) << level;
    EXPECT_GE(shape.sharpness, level == 0 ? 0.55 : 0.65) << level;
    EXPECT_LE(shape.bottom_rms_mm, bottom_h * h) << level;
  }
}

TEST_P(CreaseShapeOf, DeepensEvenlyWithEveryStroke) {
  for (const int level : {0, 1, 2}) {
    const double h = kCreaseVoxel * (1 << level);
    const evaluation::CreaseShape two = shape_after(2, level, GetParam());
    EXPECT_NEAR(two.depth_mm, 4.0 * h, 0.2 * h) << level;
    const evaluation::CreaseShape three = shape_after(3, level, GetParam());
    EXPECT_GT(three.depth_mm, 5.0 * h) << level;
    EXPECT_LE(three.bottom_rms_mm, 0.03 * h) << level;
  }
}
INSTANTIATE_TEST_SUITE_P(Clay, CreaseShapeOf, testing::Values(Action::crease, Action::ridge));

// ---- What a stroke does and does not depend on
// ---------------------------------------------------

constexpr double kSlabTop = 8.0;
constexpr double kBladeRadius = 4.0;
constexpr double kBladeDepth = kBladeRadius / 4.0;

Clay crease_slab() {
  return Clay::block({36, 36, 2 * kSlabTop}, ClayOptions{.voxel_mm = kCreaseVoxel}).value();
}

double slab_top_at(const Clay& clay, double x, double y) {
  const auto hit = pick(clay, Ray{{x, y, 100}, {0, 0, -1}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z - kSlabTop : std::nan("");
}

Stroke blade(Action action, double strength, const std::vector<Vec3>& places) {
  return stroke_of(action, kBladeRadius, strength, places);
}

std::vector<Vec3> passes_over_slab(int passes) {
  std::vector<Vec3> places;
  for (int n = 0; n <= passes; ++n) places.push_back({n % 2 == 0 ? -6.0 : 6.0, 0.1, kSlabTop});
  return places;
}

TEST(ActionCrease, IsAsDeepAsItsStrengthHoweverOftenAStrokePasses) {
  for (const double strength : {1.0, 0.5, -1.0}) {
    for (const int passes : {1, 5}) {
      Clay clay = crease_slab();
      ASSERT_TRUE(clay.apply(blade(Action::crease, strength, passes_over_slab(passes))).ok());
      for (double x = -6.0; x <= 6.0; x += 0.37) {
        EXPECT_NEAR(slab_top_at(clay, x, 0.1), -strength * kBladeDepth, 0.2 * kCreaseVoxel)
            << strength << " at " << x;
      }
      // (1 - 1/2)^2 of it halfway, with the point as round as it is; beyond the width nothing.
      EXPECT_NEAR(slab_top_at(clay, 0, 1.3), -0.27 * strength * kBladeDepth, 0.1 * kCreaseVoxel);
      EXPECT_NEAR(slab_top_at(clay, 0, 2.6), 0.0, 0.02 * kCreaseVoxel);
      EXPECT_THAT(clay.validate(), IsEmpty());
    }
  }
}

TEST(ActionCrease, IsTheSameUpsideDownAsARidge) {
  Clay crease = crease_slab();
  Clay ridge = crease_slab();
  ASSERT_TRUE(crease.apply(blade(Action::crease, -0.8, passes_over_slab(1))).ok());
  ASSERT_TRUE(ridge.apply(blade(Action::ridge, 0.8, passes_over_slab(1))).ok());
  EXPECT_EQ(crease.hash(), ridge.hash());
  EXPECT_NEAR(slab_top_at(ridge, 0, 0.1), 0.8 * kBladeDepth, 0.2 * kCreaseVoxel);
}

TEST(ActionCrease, IsAsWideAndAsSharpAsAsked) {
  Clay usual = crease_slab();
  Clay wide = crease_slab();
  Clay round = crease_slab();
  Stroke stroke = blade(Action::crease, 1.0, passes_over_slab(1));
  ASSERT_TRUE(usual.apply(stroke).ok());
  stroke.tool.width = 1.0;
  ASSERT_TRUE(wide.apply(stroke).ok());
  stroke.tool.sharpness = 0.0;
  ASSERT_TRUE(round.apply(stroke).ok());
  EXPECT_NEAR(slab_top_at(usual, 0, 3.1), 0.0, 0.02 * kCreaseVoxel);
  EXPECT_NEAR(slab_top_at(wide, 0, 2.1), -0.25 * kBladeDepth, 0.1 * kCreaseVoxel);
  // The falloff of other tools: (1 - (1/2)^2)^2 halfway.
  EXPECT_NEAR(slab_top_at(round, 0, 2.1), -0.5625 * kBladeDepth, 0.1 * kCreaseVoxel);
  for (const Clay* clay : {&usual, &wide, &round}) {
    EXPECT_NEAR(slab_top_at(*clay, 0, 0.1), -kBladeDepth, 0.2 * kCreaseVoxel);
  }
}

TEST(ActionCrease, FollowsThePressure) {
  Clay clay = crease_slab();
  Stroke stroke = blade(Action::crease, 1.0, {{-8, 0.1, kSlabTop}, {8, 0.1, kSlabTop}});
  stroke.samples[0].pressure = 0.25;
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double x = -7.0; x <= 7.0; x += 0.5) {
    const double pressure = 0.25 + 0.75 * (x + 8.0) / 16.0;
    EXPECT_NEAR(slab_top_at(clay, x, 0.1), -pressure * kBladeDepth, 0.25 * kCreaseVoxel) << x;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// A hand that works a little over or under the surface leaves as much, and far off nothing.
TEST(ActionCrease, DoesNotDependOnHowFarOffTheHandIs) {
  for (const double off : {-0.45, 0.0, 0.45, 1.05}) {
    Clay clay = crease_slab();
    const double z = kSlabTop + off * kBladeRadius;
    ASSERT_TRUE(clay.apply(blade(Action::crease, 1.0, {{-6, 0.1, z}, {6, 0.1, z}})).ok());
    EXPECT_NEAR(slab_top_at(clay, 0, 0.1), off > 1.0 ? 0.0 : -kBladeDepth, 0.2 * kCreaseVoxel)
        << off;
  }
}

/// A knob on leaves finer than the tool's goes down in one piece.
TEST(ActionCrease, TakesFineDetailAlong) {
  constexpr double kRadius = 6.0;
  Clay clay = crease_slab();
  ASSERT_TRUE(clay.apply(stroke_of(Action::add, 0.8, 1.0, {{0, 1.2, kSlabTop}})).ok());
  const double top = slab_top_at(clay, 0, 1.2);
  ASSERT_NEAR(top, 0.8, 0.1);
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::crease, kRadius, 1.0, {{-6, 0.1, kSlabTop}, {6, 0.1, kSlabTop}}))
          .ok());
  const double x = 1.1 / (0.6 * kRadius);
  EXPECT_NEAR(slab_top_at(clay, 0, 1.2), top - 0.25 * kRadius * (1.0 - x) * (1.0 - x),
              0.6 * kCreaseVoxel);
  const TriangleMesh mesh = extract_surface(clay);
  EXPECT_EQ(test::find_mesh_faults(mesh), test::MeshFaults{});
  EXPECT_EQ(test::euler_characteristic(mesh), 2);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(ActionCrease, LeavesTheBackOfAThinWall) {
  Clay clay = Clay::block({3, 30, 30}, ClayOptions{.voxel_mm = 0.25}).value();
  ASSERT_TRUE(clay.apply(blade(Action::crease, 1.0, {{1.5, -6, 0.1}, {1.5, 6, 0.1}})).ok());
  EXPECT_NEAR(clay.distance_at({0.5, 0.0, 0.1}), 0.0, 0.06);
  for (double y = -6.0; y <= 6.0; y += 0.5) {
    EXPECT_NEAR(clay.distance_at({-1.5, y, 0.1}), 0.0, 0.01) << y;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// A tool so large that the coarsest level's band is less deep than its profile.
TEST(ActionCrease, IsDeeperThanTheCoarsestBand) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.5}).value();
  const double coarsest = clay.level_stats().back().voxel_mm;
  const double radius = 16.0 * coarsest;
  ASSERT_GT(radius / 4.0, 3.0 * coarsest);
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(clay.apply(stroke_of(Action::crease, radius, 1.0, {{10, 0, 0}})).ok());
  EXPECT_NE(clay.hash(), before);
  EXPECT_GT(clay.distance_at({10.0 - coarsest, 0, 0}), 0.0) << "as deep as a coarsest voxel";
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

TEST(ActionCrease, MakesAllImagesAlike) {
  Stroke stroke = blade(Action::crease, 1.0, {{5, 0.1, kSlabTop}, {11, 0.1, kSlabTop}});
  stroke.radial = {4, 2};
  Clay clay = crease_slab();
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double x = 5.0; x <= 11.0; x += 0.4) {
    const double first = slab_top_at(clay, x, 0.1);
    EXPECT_NEAR(first, -kBladeDepth, 0.2 * kCreaseVoxel) << x;
    EXPECT_NEAR(slab_top_at(clay, -x, -0.1), first, 1e-5) << x;
    EXPECT_NEAR(slab_top_at(clay, -0.1, x), first, 2e-3 * kCreaseVoxel) << x;
    EXPECT_NEAR(slab_top_at(clay, 0.1, -x), first, 2e-3 * kCreaseVoxel) << x;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(ActionCreaseGolden, GivesTheSameBitsForAnyThreadCountAndInPieces) {
  const double r = 10.0;
  for (const Action action : {Action::crease, Action::ridge}) {
    Stroke stroke = stroke_of(action, 3.0, 0.8, {{9, -3, 1}, {r, 0, 1}, {9, 3, 2}, {9, -3, 1}});
    stroke.mirror.z = true;
    stroke.radial = {2, 2};
    std::vector<std::uint64_t> hashes;
    for (const std::size_t threads : {1U, 2U, 4U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Clay whole = Clay::ball(r, ClayOptions{.voxel_mm = kCreaseVoxel}).value();
      Clay pieces = Clay::ball(r, ClayOptions{.voxel_mm = kCreaseVoxel}).value();
      const std::uint64_t start = whole.hash();
      ASSERT_TRUE(whole.apply(stroke).ok());
      hashes.push_back(whole.hash());
      ASSERT_TRUE(pieces.begin_stroke(stroke.tool, stroke).ok());
      for (const StrokeSample& sample : stroke.samples) {
        ASSERT_TRUE(pieces.extend_stroke({&sample, 1}).ok());
      }
      ASSERT_TRUE(pieces.end_stroke().ok());
      hashes.push_back(pieces.hash());
      ASSERT_TRUE(whole.undo());
      EXPECT_EQ(whole.hash(), start);
      ASSERT_TRUE(whole.redo());
      hashes.push_back(whole.hash());
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]) << info_of(action).name;
  }
}

// ---- Random strokes -----------------------------------------------------------------------------

TEST(CreaseProperty, LeavesASurfaceThatIsClosedAndMeetsItselfNowhere) {
  for (int n = 0; n < test::effort(3, 12); ++n) {
    const auto seed = static_cast<std::uint32_t>(9100 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto some = [&](double lo, double hi) {
      return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
    };
    Clay clay = random_start(random);
    for (int i = 0; i < 6; ++i) {
      std::vector<Vec3> places;
      Vec3 at{some(-9, 9), some(-9, 9), some(-9, 9)};
      for (int k = 0; k < 6; ++k) {
        places.push_back(some(6.0, 10.0) * normalized(at));
        at += Vec3{some(-3, 3), some(-3, 3), some(-3, 3)};
      }
      Stroke stroke = stroke_of(random() % 2 == 0 ? Action::crease : Action::ridge,
                                std::exp2(some(-0.5, 2.0)), some(0.3, 1.0), places);
      stroke.tool.sharpness = some(0.0, 1.0);
      stroke.tool.width = some(0.3, 1.0);
      stroke.mirror.x = random() % 3 == 0;
      ASSERT_TRUE(clay.apply(stroke).ok());
    }
    ASSERT_THAT(clay.validate(), IsEmpty());
    const TriangleMesh mesh = extract_surface(clay);
    ASSERT_EQ(test::find_mesh_faults(mesh), test::MeshFaults{});
    ASSERT_EQ(test::find_soup_faults(mesh).crossing_pairs, 0U);
  }
}

}  // namespace
}  // namespace argil
