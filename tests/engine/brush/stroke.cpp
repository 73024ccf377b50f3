// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"

#include "support/effort.h"
#include "tool/posed_tool.h"

namespace argil {
namespace {

Stroke straight(Action action, double radius_mm, double spacing, const Vec3& from, const Vec3& to) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {radius_mm, radius_mm, radius_mm}, 1.0};
  stroke.spacing = spacing;
  stroke.samples = {{0.0, from, {}, 1.0}, {1.0, to, {}, 1.0}};
  return stroke;
}

double depth_at(const Clay& clay, double y, double z) {
  const auto hit = pick(clay, Ray{{100.0, y, z}, {-1.0, 0.0, 0.0}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.x : std::nan("");
}

// ---- sweep and spacing -------------------------------------------------------------------------

/// The bottom of a groove, or the top of a bar, along the middle of a straight stroke.
double ripple(Action action, Shape shape, double spacing) {
  const double half_mm = test::effort(3.0, 15.0);
  Clay clay = Clay::block({12, 2.0 * half_mm + 10.0, 16}, ClayOptions{.voxel_mm = 0.125}).value();
  Stroke stroke = straight(action, 2.0, spacing, {6, -half_mm, 0}, {6, half_mm, 0});
  stroke.tool.shape = shape;
  if (shape == Shape::ellipsoid) stroke.tool.radii_mm = {2.0, 2.5, 3.0};
  if (shape == Shape::box) stroke.tool.radii_mm = {2.0, 2.0, 2.0};
  if (shape == Shape::capsule) stroke.tool.radii_mm = {2.0, 2.0, 4.0};
  EXPECT_TRUE(clay.apply(stroke).ok());
  double low = 1e9;
  double high = -1e9;
  for (double y = 1.0 - half_mm; y <= half_mm - 1.0; y += 0.1) {
    const double depth = depth_at(clay, y, 0.0);
    low = std::min(low, depth);
    high = std::max(high, depth);
  }
  return high - low;
}

/// Usually each shape either adds or carves: what is swept is the same.
TEST(StrokeSweep, LeavesNoBeadsHoweverFarApartTheDabsLie) {
  for (const Action action : {Action::add, Action::carve}) {
    for (const Shape shape : {Shape::ball, Shape::ellipsoid, Shape::box, Shape::capsule}) {
      const bool adds = shape == Shape::ellipsoid || shape == Shape::capsule;
      if (!test::effort(adds == (action == Action::add), true)) continue;
      for (const double spacing : test::effort<std::vector<double>>({2.0}, {0.25, 1.0, 2.0})) {
        EXPECT_LE(ripple(action, shape, spacing), 0.05 * 2.0)
            << static_cast<int>(action) << " shape " << static_cast<int>(shape) << " spacing "
            << spacing;
      }
    }
  }
}

/// The farthest that two clays' surfaces lie apart under a stroke, in voxels.
double apart_voxels(const Clay& a, const Clay& b, double voxel_mm) {
  double most = 0.0;
  for (double y = -6.0; y <= 6.0; y += 0.11) {
    for (double z = -2.5; z <= 2.5; z += 0.13) {
      most = std::max(most, std::abs(depth_at(a, y, z) - depth_at(b, y, z)));
    }
  }
  return most / voxel_mm;
}

TEST(StrokeSpacing, HardlyMattersForTheResult) {
  struct Case {
    Action action;
    double strength;
    double most_voxels;
  };
  // Drawn and moved surfaces are redistanced by each dab: with longer steps they end a little
  // elsewhere, most at the ends of the stroke. The groove and the rim before each dab are rounded
  // as if tool and clay were flat there, and what that adds stays: most of a small tool.
  for (const Case& c :
       {Case{Action::add, 1.0, 0.3}, Case{Action::carve, 1.0, 0.3}, Case{Action::add, 0.6, 0.65},
        Case{Action::smooth, 0.5, 0.1}, Case{Action::inflate, 0.5, 0.3}}) {
    Clay fine = Clay::ball(20.0, ClayOptions{.voxel_mm = 0.2}).value();
    Clay coarse = Clay::ball(20.0, ClayOptions{.voxel_mm = 0.2}).value();
    Stroke stroke = straight(c.action, 3.0, 0.05, {19.5, -4, 0}, {19.5, 4, 0});
    stroke.tool.strength = c.strength;
    ASSERT_TRUE(fine.apply(stroke).ok());
    stroke.spacing = 0.25;
    ASSERT_TRUE(coarse.apply(stroke).ok());
    const double apart = apart_voxels(fine, coarse, 0.2);
    std::printf("action %d: %.3f voxels apart\n", static_cast<int>(c.action), apart);
    EXPECT_LE(apart, c.most_voxels) << static_cast<int>(c.action);
  }
}

/// A stroke along an arc on a ball of 20 mm, in a tenth of a second times `slower`.
Stroke arc(Action action, double slower) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {3.0, 3.0, 3.0}, 1.0};
  stroke.mirror.z = true;
  for (int n = 0; n <= 100; ++n) {
    const double turn = -0.5 + 0.01 * n;
    stroke.samples.push_back({1e-3 * slower * n,
                              {20.0 * std::cos(turn), 20.0 * std::sin(turn), 3.0 * turn},
                              {},
                              0.5 + 0.005 * n});
  }
  return stroke;
}

TEST(JoinedDabs, FallWhereThoseOfASlowHandFallAndEightMsApart) {
  const std::vector<Dab> fast = dabs_of(arc(Action::carve, 1.0));
  const std::vector<Dab> slow = dabs_of(arc(Action::carve, 100.0));
  const std::vector<Dab> moved = dabs_of(arc(Action::inflate, 1.0));
  ASSERT_EQ(fast.size(), slow.size());
  ASSERT_GT(fast.size(), 40U);
  std::size_t edits = 0;
  for (std::size_t n = 0; n < fast.size(); ++n) {
    EXPECT_EQ(fast[n].at.position_mm, slow[n].at.position_mm);
    EXPECT_EQ(fast[n].from.position_mm, slow[n].from.position_mm);
    EXPECT_EQ(fast[n].is_mirrored, n % 2 == 1);
    EXPECT_EQ(fast[n].is_joined, fast[n ^ 1U].is_joined) << "of a dab and its image";
    EXPECT_FALSE(slow[n].is_joined);
    if (n % 2 == 0 && !fast[n].is_joined) ++edits;
  }
  EXPECT_FALSE(fast.back().is_joined);
  EXPECT_LE(edits, 100 / 8 + 2U);
  EXPECT_GE(edits, 5U);
  for (const Dab& dab : moved) EXPECT_FALSE(dab.is_joined);
}

/// Where all poses have one time, the path ends an edit.
TEST(JoinedDabs, AreAtMostTwoRadiiLong) {
  double path_mm = 0.0;
  for (const Dab& dab : dabs_of(arc(Action::add, 0.0))) {
    if (dab.is_mirrored) continue;
    path_mm += length(dab.at.position_mm - dab.from.position_mm);
    EXPECT_LE(path_mm, 2.0 * 3.0 + 0.76);
    if (!dab.is_joined) path_mm = 0.0;
  }
}

/// Where pressure makes one end of a path thin, the rest is not refined for it.
TEST(JoinedDabs, OfAPenAreEachAsFineAsTheirSize) {
  std::array<std::int64_t, 2> leaves{};
  for (const bool is_joined : {false, true}) {
    Clay clay = Clay::ball(20.0, ClayOptions{.voxel_mm = 0.1}).value();
    Stroke pen = arc(Action::add, is_joined ? 0.0 : 100.0);
    pen.mirror = {};
    pen.tool.radii_mm = {8.0, 8.0, 8.0};
    pen.tool.pressure_to_size = 1.0;
    for (std::size_t n = 0; n < pen.samples.size(); ++n) {
      pen.samples[n].pressure = 0.02 + 0.0098 * static_cast<double>(n);
    }
    ASSERT_TRUE(clay.set_limits({.memory_bytes = clay.use().level_bytes + (100 << 20)}).ok());
    const auto report = clay.apply(pen);
    ASSERT_TRUE(report.ok()) << report.error().message;
    leaves[is_joined ? 1 : 0] = clay.use().level_bytes;
  }
  EXPECT_LE(static_cast<double>(leaves[1]), 1.1 * static_cast<double>(leaves[0]));
}

TEST(JoinedDabs, DoNotWaitForAHandThatSendsFewSamples) {
  Stroke stroke = arc(Action::carve, 20.0);  // 20 ms from sample to sample, dabs closer than 8 ms
  for (StrokeSample& sample : stroke.samples) sample.position_mm *= 4.0;
  DabFeeder feeder(stroke.tool, stroke);
  for (const StrokeSample& sample : stroke.samples) {
    std::vector<Dab> dabs;
    feeder.feed(sample, dabs);
    ASSERT_FALSE(dabs.empty());
    EXPECT_FALSE(dabs.back().is_joined);
    const Vec3& last = dabs[dabs.size() - 2].at.position_mm;
    EXPECT_LT(length(last - sample.position_mm), 0.76) << "less than a step is left";
  }
}

Clay after_arc(Action action, double slower, double voxel_mm) {
  Clay clay = Clay::ball(20.0, ClayOptions{.voxel_mm = voxel_mm}).value();
  EXPECT_TRUE(clay.apply(arc(action, slower)).ok());
  EXPECT_TRUE(clay.validate().empty());
  return clay;
}

/// Each edit may coarsen what it leaves, by the clay's tolerance: fewer edits, no more error.
TEST(JoinedDabs, MakeTheClayOfASlowHand) {
  for (const Action action : {Action::add, Action::carve}) {
    const Clay exact = after_arc(action, 100.0, 0.05);
    const double fast = apart_voxels(after_arc(action, 1.0, 0.2), exact, 0.2);
    const double slow = apart_voxels(after_arc(action, 100.0, 0.2), exact, 0.2);
    const double ball = apart_voxels(Clay::ball(20.0, {.voxel_mm = 0.2}).value(), exact, 0.2);
    std::printf("action %d: %.4f, of a slow hand %.4f, nothing done %.2f voxels\n",
                static_cast<int>(action), fast, slow, ball);
    EXPECT_LE(fast, slow + 0.3);
    EXPECT_GT(ball, 5.0);
  }
}

TEST(StrokeSpacing, SweepsToTheLastSample) {
  Clay clay = Clay::block({12, 40, 16}, ClayOptions{.voxel_mm = 0.25}).value();
  ASSERT_TRUE(clay.apply(straight(Action::carve, 2.0, 2.0, {6, 0, 0}, {6, 3, 0})).ok());
  EXPECT_NEAR(clay.distance_at({6, 5, 0}), 0.0, 0.17);
}

// ---- the hand ----------------------------------------------------------------------------------

TEST(SteadyStroke, DrawsTheToolOnAString) {
  Stroke stroke;
  stroke.tool.radii_mm = {1, 1, 1};
  stroke.steady_mm = 3.0;
  for (int i = 0; i <= 100; ++i) {
    const double wobble = i % 2 == 0 ? 0.5 : -0.5;
    stroke.samples.push_back({0.01 * i, {0.2 * i, wobble, 0}, {}, 1.0});
  }
  const std::vector<Dab> dabs = dabs_of(stroke);
  EXPECT_NEAR(dabs.back().at.position_mm.x, 17.0, 0.1);
  double most = 0.0;
  for (const Dab& dab : dabs) most = std::max(most, std::abs(dab.at.position_mm.y));
  EXPECT_LT(most, 0.51);
  double late = 0.0;
  for (std::size_t i = dabs.size() / 2; i < dabs.size(); ++i) {
    late = std::max(late, std::abs(dabs[i].at.position_mm.y - dabs[i - 1].at.position_mm.y));
  }
  EXPECT_LT(late, 0.1);
}

TEST(HoldStill, RepeatsTheDabInTimeAndNotAcrossAPause) {
  Stroke stroke;
  stroke.tool = {Action::inflate, Shape::ball, {1, 1, 1}, 1.0};
  stroke.hold_s = 0.1;
  stroke.samples = {{0.0, {0, 0, 0}, {}, 1.0}, {1.05, {0, 0, 0}, {}, 1.0}};
  EXPECT_EQ(dabs_of(stroke).size(), 11U);
  stroke.samples.push_back({1e9, {0, 0, 0}, {}, 1.0});
  EXPECT_EQ(dabs_of(stroke).size(), 111U);
  stroke.hold_s = 0.0;
  EXPECT_EQ(dabs_of(stroke).size(), 1U);
}

TEST(Pressure, DecidesSizeAndStrengthAsAsked) {
  Tool tool;
  tool.radii_mm = {2, 2, 2};
  tool.strength = 0.8;
  const DabPose at{{0, 0, 0}, {}, 0.5};
  EXPECT_NEAR(PosedTool(tool, {at, at}).strength(), 0.4, 1e-12);
  EXPECT_NEAR(PosedTool(tool, {at, at}).smallest_radius_mm(), 2.0, 1e-12);
  tool.pressure_to_strength = 0.0;
  tool.pressure_to_size = 1.0;
  EXPECT_NEAR(PosedTool(tool, {at, at}).strength(), 0.8, 1e-12);
  EXPECT_NEAR(PosedTool(tool, {at, at}).smallest_radius_mm(), 1.0, 1e-12);
  Clay clay = Clay::ball(5.0, ClayOptions{.voxel_mm = 0.5}).value();
  const std::uint64_t before = clay.hash();
  Stroke stroke;
  stroke.tool = tool;
  stroke.samples = {{0.0, {5, 0, 0}, {}, 0.0}};
  for (const Action action : {Action::add, Action::smooth, Action::grab, Action::crease}) {
    stroke.tool.action = action;
    ASSERT_TRUE(clay.apply(stroke).ok());
    EXPECT_EQ(clay.hash(), before) << static_cast<int>(action);
  }
}

TEST(StrokeSample, RefusesNumbersOutOfRange) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto is_taken = [](const StrokeSample& sample) {
    const auto valid = validate_samples(std::array{StrokeSample{}, sample});
    EXPECT_TRUE(valid.ok() || valid.error().message.starts_with("poses[1]: "));
    return valid.ok();
  };
  for (const double bad : {kNan, kInfinite, -kInfinite, 1e308, -1e308}) {
    StrokeSample sample;
    sample.time_s = bad;
    EXPECT_FALSE(is_taken(sample)) << bad;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sample = {};
      sample.position_mm[axis] = bad;
      EXPECT_FALSE(is_taken(sample)) << bad;
    }
    sample = {};
    sample.orientation.x = bad;
    EXPECT_FALSE(is_taken(sample)) << bad;
    sample = {};
    sample.pressure = bad;
    EXPECT_FALSE(is_taken(sample)) << bad;
  }
  StrokeSample last;
  last.time_s = 1e12;
  EXPECT_TRUE(is_taken(last));
  last.time_s = 1.1e12;
  const auto refused = validate_samples(std::array{last});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "poses[0]: the time is 1.1e+12 s; must be from -1e12 to 1e12 s");
}

TEST(StrokeStyle, RefusesNumbersOutOfRange) {
  const auto message = [](const StrokeStyle& style) {
    const Result<void> ok = validate_brush({}, style);
    return ok ? std::string("accepted") : ok.error().message;
  };
  EXPECT_EQ(message({}), "accepted");
  EXPECT_NE(message({.spacing = std::nan("")}).find("spacing"), std::string::npos);
  EXPECT_NE(message({.radial = {0, 2}}).find("radial repeats 0"), std::string::npos);
  EXPECT_NE(message({.radial = {3, 7}}).find("axis 7"), std::string::npos);
  EXPECT_NE(message({.steady_mm = -1.0}).find("steady_mm is -1"), std::string::npos);
  EXPECT_NE(message({.hold_s = 0.001}).find("hold_s is 0.001"), std::string::npos);
}

// ---- dots --------------------------------------------------------------------------------------

TEST(StrokeDots, AreOneDabForEachSampleWhereverItLies) {
  Stroke stroke;
  stroke.has_dots = true;
  stroke.hold_s = 0.01;
  stroke.spacing = 0.05;
  stroke.tool.radii_mm = {2, 2, 2};
  for (const Action action : {Action::inflate, Action::add, Action::crease}) {
    stroke.tool.action = action;
    stroke.samples = {{0.0, {0, 0, 0}, {}, 1.0},
                      {1.0, {9, 0, 0}, {}, 0.5},
                      {1.001, {9, 0, 0}, {}, 0.5},
                      {4.0, {9.1, 0, 0}, {}, 0.25}};
    const auto dabs = dabs_of(stroke);
    ASSERT_EQ(dabs.size(), 4U) << static_cast<int>(action);
    for (std::size_t n = 0; n < dabs.size(); ++n) {
      EXPECT_EQ(dabs[n].at.position_mm, stroke.samples[n].position_mm);
      EXPECT_EQ(dabs[n].from.position_mm, dabs[n].at.position_mm) << "nothing sweeps between dots";
      EXPECT_EQ(dabs[n].at.pressure, stroke.samples[n].pressure);
      EXPECT_EQ(dabs[n].quarters, 1.0);
      EXPECT_FALSE(dabs[n].is_joined);
    }
    stroke.mirror.x = true;
    EXPECT_EQ(dabs_of(stroke).size(), 8U);
    const DabFeeder feeder(stroke.tool, stroke);
    EXPECT_EQ(feeder.most_dabs(stroke.samples), 8.0);
    stroke.mirror.x = false;
  }
}

TEST(StrokeDots, LeaveTheClayOfThatManyStrokes) {
  const std::vector<Vec3> places{{10, 0, 0}, {9.5, 3, 0}, {9.4, 3.2, 0}, {8, 6, 0}};
  Clay dotted = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value();
  Stroke stroke;
  stroke.has_dots = true;
  stroke.tool.action = Action::add;
  stroke.tool.radii_mm = {1.5, 1.5, 1.5};
  for (const Vec3& place : places) stroke.samples.push_back({0.0, place, {}, 1.0});
  ASSERT_TRUE(dotted.apply(stroke).ok());
  EXPECT_EQ(dotted.undo_depth(), 1);
  Clay single = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value();
  for (const StrokeSample& sample : stroke.samples) {
    Stroke one = stroke;
    one.has_dots = false;
    one.samples = {sample};
    ASSERT_TRUE(single.apply(one).ok());
  }
  for (double x = 6.0; x < 12.0; x += 0.37) {
    for (double y = -2.0; y < 9.0; y += 0.41) {
      const double wanted = single.distance_at({x, y, 0.1});
      if (std::abs(wanted) > 0.4) continue;
      EXPECT_NEAR(dotted.distance_at({x, y, 0.1}), wanted, 0.08) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace argil
