// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kFalloffVoxel = 0.2;
constexpr double kFalloffRadius = 8.0;
constexpr double kFalloffSlabHalf = 6.0;

Clay falloff_slab() {
  return Clay::block({40, 40, 2 * kFalloffSlabHalf}, ClayOptions{.voxel_mm = kFalloffVoxel})
      .value();
}

double slab_height(const Clay& clay, double x) {
  const auto hit = pick(clay, Ray{{x, 0.03, 100.0}, {0.0, 0.0, -1.0}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z - kFalloffSlabHalf : std::nan("");
}

Stroke falloff_stroke(Action action, Falloff falloff) {
  Stroke stroke = stroke_of(action, kFalloffRadius, 1.0, {{0, 0, kFalloffSlabHalf}});
  stroke.tool.falloff = falloff;
  return stroke;
}

std::string falloff_name(const testing::TestParamInfo<Falloff>& info) {
  return std::string(kFalloffNames.at(static_cast<std::size_t>(info.param)));
}

class FalloffOf : public testing::TestWithParam<Falloff> {};

TEST_P(FalloffOf, FallsFromOneToNothingAndIsSteepWhereItIsSaidToBe) {
  const Falloff falloff = GetParam();
  EXPECT_EQ(fall_off(falloff, 0.0), 1.0);
  EXPECT_EQ(fall_off(falloff, 1.0), 0.0);
  EXPECT_EQ(fall_off(falloff, 7.0), 0.0);
  constexpr int kSteps = 10'000;
  double steepest = 0.0;
  for (int n = 0; n < kSteps; ++n) {
    const double rho = 1.0 * n / kSteps;
    const double next = 1.0 * (n + 1) / kSteps;
    const double fall = fall_off(falloff, rho * rho) - fall_off(falloff, next * next);
    EXPECT_GE(fall, 0.0);
    steepest = std::max(steepest, kSteps * fall);
  }
  EXPECT_EQ(steepest < 2.001, is_gentle(falloff)) << steepest;
}

/// A layer is as high as the falloff says: the form of the curve in the clay.
TEST_P(FalloffOf, IsTheFormOfALayer) {
  const Falloff falloff = GetParam();
  Clay clay = falloff_slab();
  ASSERT_TRUE(clay.apply(falloff_stroke(Action::layer, falloff)).ok());
  const double middle = slab_height(clay, 0.0);
  // A point, or a kink, in the middle is as sharp as voxels are.
  EXPECT_NEAR(middle, 0.25 * kFalloffRadius, 0.6 * kFalloffVoxel);
  double worst = 0.0;
  for (const double rho : {0.2, 0.35, 0.5, 0.65, 0.8, 0.9}) {
    const double wanted = 0.25 * kFalloffRadius * fall_off(falloff, rho * rho);
    const double found = slab_height(clay, rho * kFalloffRadius);
    worst = std::max(worst, std::abs(found - wanted));
    EXPECT_NEAR(found, wanted, 0.5 * kFalloffVoxel) << rho;
  }
  std::printf("off by at most %.3f voxel\n", worst / kFalloffVoxel);
  // The foot of a step is as round as smoothing its distances makes it.
  const double beyond = falloff == Falloff::constant ? 1.25 : 1.1;
  EXPECT_NEAR(slab_height(clay, beyond * kFalloffRadius), 0.0, 0.1 * kFalloffVoxel);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST_P(FalloffOf, LeavesClosedClayWithEachActionThatTakesIt) {
  int taken = 0;
  for (const ActionInfo& info : kActionInfos) {
    if (info.curves == Curves::none || !takes(info.action, GetParam())) continue;
    SCOPED_TRACE(info.name);
    Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value();
    const std::uint64_t before = clay.hash();
    Stroke stroke = stroke_of(info.action, 4.0, 0.9, {{10, 0, 0}, {11, 2, 0}, {9, 5, 0}});
    stroke.tool.falloff = GetParam();
    stroke.mirror.y = true;
    ASSERT_TRUE(clay.apply(stroke).ok());
    EXPECT_NE(clay.hash(), before);
    EXPECT_THAT(clay.validate(), IsEmpty());
    EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
    ASSERT_TRUE(clay.undo());
    EXPECT_EQ(clay.hash(), before);
    ++taken;
  }
  EXPECT_EQ(taken, is_gentle(GetParam()) ? 14 : 9);
}

INSTANTIATE_TEST_SUITE_P(Actions, FalloffOf,
                         testing::Values(Falloff::smooth, Falloff::smoother, Falloff::sphere,
                                         Falloff::root, Falloff::sharp, Falloff::linear,
                                         Falloff::sharper, Falloff::inverse_square,
                                         Falloff::constant),
                         falloff_name);

TEST(FalloffBadInput, IsRefusedWhereItWouldFoldMatter) {
  for (const Action action :
       {Action::grab, Action::pinch, Action::twist, Action::slide, Action::snake_hook}) {
    Clay clay = falloff_slab();
    const std::uint64_t before = clay.hash();
    const auto done = clay.apply(falloff_stroke(action, Falloff::sphere));
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(
        done.error().message,
        HasSubstr(std::string("falloff is \"sphere\", so steep that \"") + info_of(action).name +
                  "\" would fold the matter it moves; use one of smooth, smoother, sharp, "
                  "linear, inverse_square"));
    EXPECT_EQ(clay.hash(), before);
  }
}

TEST(Falloff, IsUnreadWhereAnActionHasNone) {
  for (const Action action : {Action::add, Action::crease, Action::elastic, Action::clay_strips}) {
    Clay usual = falloff_slab();
    Clay other = falloff_slab();
    ASSERT_TRUE(usual.apply(falloff_stroke(action, Falloff::smooth)).ok());
    ASSERT_TRUE(other.apply(falloff_stroke(action, Falloff::constant)).ok());
    EXPECT_EQ(usual.hash(), other.hash());
  }
}

}  // namespace
}  // namespace argil
