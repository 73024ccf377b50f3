// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "argil/engine/clay.h"

namespace argil {
namespace {

Stroke dab_at(double z) {
  Stroke stroke;
  stroke.tool = {Action::carve, Shape::ball, {1.5, 1.5, 1.5}, 1.0};
  stroke.samples = {{0.0, {9, 0, z}, {}, 1.0}};
  return stroke;
}

TEST(ClayLimits, ForgetTheOldestStepsAndSayHowMany) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.3}).value();
  ASSERT_TRUE(clay.apply(dab_at(0.0)).ok());
  const std::int64_t one = clay.use().undo_bytes;
  ASSERT_GT(one, 10000);
  ASSERT_TRUE(clay.set_limits({.undo_bytes = 3 * one}).ok());
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 12; ++i) {
    hashes.push_back(clay.hash());
    ASSERT_TRUE(clay.apply(dab_at(0.4 * i - 2.0)).ok());
    EXPECT_LE(clay.use().undo_bytes, 3 * one);
  }
  EXPECT_GT(clay.use().steps_forgotten, 5);
  EXPECT_EQ(clay.undo_depth() + clay.use().steps_forgotten, 13);
  // What is kept is undone bit for bit, and again.
  const std::uint64_t last = clay.hash();
  int undone = 0;
  while (clay.undo())
    EXPECT_EQ(clay.hash(), hashes[hashes.size() - static_cast<std::size_t>(++undone)]);
  EXPECT_GE(undone, 1);
  while (clay.redo()) {
  }
  EXPECT_EQ(clay.hash(), last);
}

TEST(ClayLimits, KeepTheLastStepHoweverLargeItIs) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.3}).value();
  const std::uint64_t start = clay.hash();
  ASSERT_TRUE(clay.set_limits({.undo_bytes = 0}).ok());
  ASSERT_TRUE(clay.apply(dab_at(0.0)).ok());
  EXPECT_EQ(clay.undo_depth(), 1);
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
  ASSERT_TRUE(clay.redo());
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
}

TEST(ClayLimits, RefuseAnEditThatWouldPassTheMemoryAndLeaveTheClayWhole) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.1}).value();
  ASSERT_TRUE(clay.apply(dab_at(0.0)).ok());
  const std::uint64_t before = clay.hash();
  const ClayUse use = clay.use();
  ASSERT_TRUE(clay.set_limits({.memory_bytes = use.level_bytes + use.undo_bytes + 400000}).ok());
  Stroke large = dab_at(0.0);
  large.tool.radii_mm = {6, 6, 6};
  for (const Action action : {Action::carve, Action::smooth, Action::grab}) {
    large.tool.action = action;
    const auto refused = clay.apply(large);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::memory);
    EXPECT_NE(refused.error().message.find("memory limit"), std::string::npos);
    EXPECT_EQ(clay.hash(), before);
    EXPECT_TRUE(clay.validate().empty());
    EXPECT_FALSE(clay.is_stroke_open());
  }
  ASSERT_TRUE(clay.set_limits({}).ok());
  EXPECT_TRUE(clay.apply(large).ok());
}

TEST(ClayLimits, RefuseMoreDabsThanMemoryHolds) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.1}).value();
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(clay.set_limits({.memory_bytes = clay.use().level_bytes + (8 << 20)}).ok());
  Stroke tiny = dab_at(0.0);
  tiny.tool.radii_mm = {0.01, 0.01, 0.01};
  tiny.spacing = 0.05;
  tiny.samples.resize(1);
  StrokeSample end = tiny.samples[0];
  end.time_s += 1.0;
  end.position_mm += Vec3{50, 0, 0};
  tiny.samples.push_back(end);
  const auto refused = clay.apply(tiny);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::memory);
  EXPECT_NE(refused.error().message.find("100"), std::string::npos) << refused.error().message;
  ASSERT_TRUE(clay.begin_stroke(tiny.tool, tiny).ok());
  EXPECT_FALSE(clay.queue_stroke(tiny.samples).ok());
  EXPECT_EQ(clay.waiting_dabs(), 0);
  EXPECT_TRUE(clay.cancel_stroke());
  EXPECT_EQ(clay.hash(), before);
}

/// A minute's rest at a thousand samples a second is 600 dabs, not a hundred for each sample.
TEST(ClayLimits, AcceptALongRest) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value();
  ASSERT_TRUE(clay.set_limits({.memory_bytes = clay.use().level_bytes + (8 << 20)}).ok());
  Stroke rest = dab_at(0.0);
  rest.hold_s = 0.1;
  rest.samples.assign(60'000, rest.samples[0]);
  for (std::size_t i = 0; i < rest.samples.size(); ++i) {
    rest.samples[i].time_s = 1e-3 * static_cast<double>(i);
  }
  ASSERT_TRUE(clay.begin_stroke(rest.tool, rest).ok());
  const auto queued = clay.queue_stroke(rest.samples);
  ASSERT_TRUE(queued.ok()) << queued.error().message;
  EXPECT_EQ(clay.waiting_dabs(), 600);
  EXPECT_TRUE(clay.cancel_stroke());
}

TEST(ClayLimits, RefuseAToolThatMeetsNoNode) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.1}).value();
  Stroke tiny = dab_at(0.0);
  tiny.tool.radii_mm = {1e-9, 1e-9, 1e-9};
  const auto refused = clay.apply(tiny);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("at least 0.005"), std::string::npos)
      << refused.error().message;
}

TEST(ClayLimits, CountWhatAnOpenStrokeKeeps) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.1}).value();
  const std::int64_t before = clay.use().free_bytes;
  const Stroke stroke = dab_at(0.0);
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  ASSERT_TRUE(clay.extend_stroke(stroke.samples).ok());
  const ClayUse open = clay.use();
  const std::int64_t levels = open.level_bytes;
  ASSERT_TRUE(clay.cancel_stroke());
  EXPECT_LT(open.free_bytes, before - (levels - clay.use().level_bytes) - 2048);
  EXPECT_EQ(clay.use().free_bytes, before);
}

TEST(ClayLimits, AreThreeQuartersOfTheMachineUnlessSaid) {
  const Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 1.0}).value();
  const ClayUse use = clay.use();
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_NEAR(static_cast<double>(use.free_bytes + use.level_bytes) / machine, 0.75, 1e-6);
}

TEST(ClayLimits, AreNotNegative) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 1.0}).value();
  EXPECT_NE(clay.set_limits({.undo_bytes = -5}).error().message.find("-5"), std::string::npos);
  EXPECT_EQ(clay.limits().undo_bytes, std::int64_t{1} << 30);
}

}  // namespace
}  // namespace argil
