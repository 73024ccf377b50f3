// SPDX-License-Identifier: GPL-3.0-or-later
// A preview beside the clay it is of: the clay must not notice it, and it must not be far from what
// the clay becomes.
#include "argil/engine/preview.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/pick.h"
#include "argil/engine/surface.h"
#include "argil/engine/window.h"

#include "engine/live/previewed.h"
#include "support/alpha_maker.h"
#include "support/effort.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

/// Gives the clay a stroke in random pieces and works a random number of dabs between them.
void work_by_chance(Clay& clay, const Stroke& stroke, std::uint32_t seed) {
  std::mt19937 random(seed);
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  std::span<const StrokeSample> rest(stroke.samples);
  while (!rest.empty()) {
    const std::size_t count = std::min<std::size_t>(random() % 5, rest.size());
    ASSERT_TRUE(clay.queue_stroke(rest.first(count)).ok());
    rest = rest.subspan(count);
    for (std::uint32_t dabs = random() % 4; dabs > 0; --dabs) {
      ASSERT_TRUE(clay.work_stroke().ok());
    }
  }
}

class PreviewBacklogOf : public testing::TestWithParam<Action> {};

TEST_P(PreviewBacklogOf, LeavesTheBitsAndTheUndoStepOfTheStrokeAlone) {
  Stroke stroke =
      large_stroke(GetParam(), effort(is_anchored(GetParam()) ? 3 : 5, kPreviewSamples));
  stroke.mirror.z = true;
  Clay alone = fine_ball();
  const std::uint64_t start = alone.hash();
  const auto expected = alone.apply(stroke);
  ASSERT_TRUE(expected.ok());
  ASSERT_NE(alone.hash(), start);
  for (std::uint32_t seed = 1; seed <= effort(1U, 2U); ++seed) {
    Clay clay = fine_ball();
    const DisplaySurface shown = drawn_of(clay);
    auto preview = Preview::begin(clay, shown, stroke.tool, stroke, kPreviewToolVoxels).value();
    ASSERT_EQ(preview.has_value(), !is_painted(GetParam()));
    // The preview is drawn ahead, on another thread, while the clay follows.
    std::thread hand([&] {
      if (!preview) return;
      for (const StrokeSample& sample : stroke.samples) {
        EXPECT_TRUE(preview->extend({&sample, 1}).ok());
        EXPECT_TRUE(preview->update_surface().ok());
      }
      EXPECT_TRUE(preview->end().ok());
    });
    work_by_chance(clay, stroke, seed);
    const auto report = clay.end_stroke();
    hand.join();
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report.value().dabs, expected.value().dabs);
    EXPECT_EQ(clay.hash(), alone.hash()) << "seed " << seed;
    ASSERT_EQ(clay.undo_depth(), 1);
    EXPECT_TRUE(clay.undo());
    EXPECT_EQ(clay.hash(), start);
    EXPECT_TRUE(clay.redo());
    EXPECT_EQ(clay.hash(), alone.hash());
  }
}

std::string name_of(const testing::TestParamInfo<Action>& info) { return info_of(info.param).name; }

INSTANTIATE_TEST_SUITE_P(Actions, PreviewBacklogOf,
                         testing::Values(Action::add, Action::carve, Action::smooth, Action::grab,
                                         Action::mask),
                         name_of);

TEST(PreviewBacklog, IsWorkedOneDabAtATimeInOrder) {
  Stroke stroke = large_stroke(Action::carve, 6);
  stroke.mirror.x = true;
  Clay together = fine_ball();
  ASSERT_TRUE(together.begin_stroke(stroke.tool, stroke).ok());
  Clay apart = fine_ball();
  ASSERT_TRUE(apart.begin_stroke(stroke.tool, stroke).ok());
  EXPECT_FALSE(apart.work_stroke().value());
  const auto queued = apart.queue_stroke(stroke.samples);
  ASSERT_TRUE(queued.ok());
  EXPECT_EQ(queued.value(), apart.waiting_dabs());
  EXPECT_GT(queued.value(), 6);
  int worked = 0;
  for (const StrokeSample& sample : stroke.samples) {
    const int more = together.extend_stroke({&sample, 1}).value();
    for (int i = 0; i < more; i += 2) {  // a dab and its image
      EXPECT_TRUE(apart.work_stroke().value());
      worked += 2;
      EXPECT_EQ(apart.waiting_dabs(), queued.value() - worked);
    }
    EXPECT_EQ(apart.hash(), together.hash());
  }
  EXPECT_EQ(worked, queued.value());
  EXPECT_FALSE(apart.work_stroke().value());
}

TEST(PreviewBacklog, IsAppliedByTheEndAndForgottenByCancelling) {
  const Stroke stroke = large_stroke(Action::carve, 4);
  Clay alone = fine_ball();
  const std::uint64_t start = alone.hash();
  ASSERT_TRUE(alone.apply(stroke).ok());
  Clay clay = fine_ball();
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  ASSERT_TRUE(clay.queue_stroke(stroke.samples).ok());
  ASSERT_TRUE(clay.work_stroke().value());
  EXPECT_FALSE(clay.undo());  // it waits for the end
  EXPECT_TRUE(clay.cancel_stroke());
  EXPECT_EQ(clay.hash(), start);
  EXPECT_EQ(clay.waiting_dabs(), 0);
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  ASSERT_TRUE(clay.queue_stroke(stroke.samples).ok());
  ASSERT_TRUE(clay.end_stroke().ok());
  EXPECT_EQ(clay.hash(), alone.hash());
}

TEST(PreviewBacklog, IsAppliedBeforeWhatExtends) {
  const Stroke stroke = large_stroke(Action::carve, 4);
  Clay alone = fine_ball();
  ASSERT_TRUE(alone.apply(stroke).ok());
  Clay clay = fine_ball();
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  const std::span<const StrokeSample> samples(stroke.samples);
  const int queued = clay.queue_stroke(samples.first(3)).value();
  EXPECT_GT(clay.extend_stroke(samples.subspan(3)).value(), queued);
  EXPECT_EQ(clay.waiting_dabs(), 0);
  ASSERT_TRUE(clay.end_stroke().ok());
  EXPECT_EQ(clay.hash(), alone.hash());
}

TEST(PreviewBacklog, RefusesWhatExtendingRefuses) {
  Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve, 3);
  EXPECT_EQ(clay.queue_stroke(stroke.samples).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(clay.work_stroke().error().kind, ErrorKind::bad_input);
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  ASSERT_TRUE(clay.queue_stroke(stroke.samples).ok());
  const int waiting = clay.waiting_dabs();
  StrokeSample back = stroke.samples[0];
  EXPECT_EQ(clay.queue_stroke({&back, 1}).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(clay.waiting_dabs(), waiting);
}

TEST(Preview, IsOfTheLevelThatTheToolSpans) {
  const Clay clay = fine_ball();
  Tool tool;
  const auto level_for = [&](const Vec3& radii_voxels) {
    tool.radii_mm = radii_voxels * kPreviewVoxelMm;
    return Preview::level_of(clay, tool);
  };
  EXPECT_EQ(level_for({5, 5, 5}), 0);
  EXPECT_EQ(level_for({63.9, 63.9, 63.9}), 0);
  EXPECT_EQ(level_for({65, 65, 65}), 1);
  EXPECT_EQ(level_for({127, 127, 127}), 1);
  EXPECT_EQ(level_for({129, 129, 129}), 2);
  EXPECT_EQ(level_for({1e4, 1e4, 1e4}), clay.level_count() - 1);
  // Where the clay writes a flat tool the preview does as well.
  EXPECT_EQ(level_for({129, 129, 17}), 1);
  EXPECT_EQ(level_for({129, 129, 9}), 0);
  // What is solved anew under the tool costs more.
  tool.action = Action::smooth;
  EXPECT_EQ(level_for({31.9, 31.9, 31.9}), 0);
  EXPECT_EQ(level_for({33, 33, 33}), 1);
  EXPECT_EQ(level_for({65, 65, 65}), 2);
  // A noise is drawn as it will be, or not before.
  tool.action = Action::noise;
  tool.radii_mm = Vec3{65, 65, 65} * kPreviewVoxelMm;
  EXPECT_EQ(Preview::level_of(clay, tool), 2);
  tool.wavelength_mm = 8.5 * kPreviewVoxelMm;
  EXPECT_EQ(Preview::level_of(clay, tool), 1);
  tool.wavelength_mm = 6.0 * kPreviewVoxelMm;
  EXPECT_EQ(Preview::level_of(clay, tool), 0);
  // An image is drawn to two of its pixels, or to two voxels of the clay.
  tool.action = Action::emboss;
  tool.radii_mm = Vec3{65, 65, 65} * kPreviewVoxelMm;
  tool.alpha = test::checker_image(64, 4);
  EXPECT_EQ(Preview::level_of(clay, tool), 2);
  tool.alpha = test::checker_image(128, 4);
  EXPECT_EQ(Preview::level_of(clay, tool), 1);
  tool.alpha = test::checker_image(512, 4);
  EXPECT_EQ(Preview::level_of(clay, tool), 1);
  tool.alpha = nullptr;
  tool.action = Action::smooth;
  tool.radii_mm = {4.0, 4.0, 4.0};
  EXPECT_EQ(Preview::level_of(clay, tool, 40.1), 0);
  EXPECT_EQ(Preview::level_of(clay, tool, 19.9), 2);
}

TEST(Preview, IsNotMadeForASmallToolNorForAMask) {
  const Clay clay = fine_ball();
  Tool tool;
  tool.radii_mm = {6.3, 6.3, 6.3};
  const auto of_small = Preview::begin(clay, not_drawn(), tool);
  ASSERT_TRUE(of_small.ok());
  EXPECT_FALSE(of_small.value().has_value());
  tool.radii_mm = {6.5, 6.5, 6.5};
  EXPECT_TRUE(Preview::begin(clay, not_drawn(), tool).value().has_value());
  tool.action = Action::mask;
  const auto of_mask = Preview::begin(clay, not_drawn(), tool);
  ASSERT_TRUE(of_mask.ok());
  EXPECT_FALSE(of_mask.value().has_value());
}

TEST(Preview, RefusesWhatAStrokeRefuses) {
  Clay clay = fine_ball();
  Tool tool = large_stroke(Action::carve).tool;
  EXPECT_EQ(begin_preview(clay, tool, {.spacing = -1.0}).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(begin_preview(clay, tool, {}, 7.9).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(begin_preview(clay, tool, {}, std::nan("")).error().kind, ErrorKind::bad_input);
  tool.strength = 2.0;
  EXPECT_EQ(begin_preview(clay, tool).error().kind, ErrorKind::bad_input);
  tool.strength = 1.0;
  tool.radii_mm = {1e6, 1e6, 1e6};
  EXPECT_EQ(begin_preview(clay, tool).error().kind, ErrorKind::bad_input);
  tool.radii_mm = {4.0, 4.0, 4.0};
  ASSERT_TRUE(clay.begin_stroke(tool).ok());
  EXPECT_EQ(begin_preview(clay, tool).error().kind, ErrorKind::bad_input);
}

TEST(Preview, IsRefusedWhereTheLimitsLeaveNoMemory) {
  Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  ASSERT_TRUE(clay.set_limits({.memory_bytes = clay.use().level_bytes + 100000}).ok());
  EXPECT_EQ(clay.use().free_bytes, 100000);
  const auto refused = begin_preview(clay, stroke.tool, stroke);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::memory);
  EXPECT_NE(refused.error().message.find("preview the stroke"), std::string::npos);
}

TEST(Preview, TakesNoMoreThanTheLimitsLeft) {
  Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  const std::int64_t levels = preview_of(clay, stroke).clay().use().level_bytes;
  ASSERT_TRUE(clay.set_limits({.memory_bytes = clay.use().level_bytes + 2 * levels + 50000}).ok());
  Preview preview = preview_of(clay, stroke);
  const std::uint64_t start = preview.clay().hash();
  const auto refused = preview.extend(stroke.samples);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::memory);
  EXPECT_EQ(preview.clay().hash(), start);
}

TEST(Preview, HasTheSameBitsForAnyThreadCount) {
  const Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  const std::uint64_t usual = previewed(clay, stroke).clay().hash();
  for (const std::size_t threads : {1U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(previewed(clay, stroke).clay().hash(), usual);
  }
}

TEST(Preview, IsTheCoarserLevelsAndIgnoresWhatTheClayDoesNext) {
  Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  const Preview preview = preview_of(clay, stroke);
  ASSERT_EQ(preview.level(), 1);
  const auto of_clay = clay.level_stats();
  const auto of_preview = preview.clay().level_stats();
  ASSERT_EQ(of_preview.size() + 1, of_clay.size());
  for (std::size_t i = 0; i < of_preview.size(); ++i) {
    EXPECT_EQ(of_preview[i].voxel_mm, of_clay[i + 1].voxel_mm);
    EXPECT_EQ(of_preview[i].leaves, of_clay[i + 1].leaves);
    EXPECT_EQ(of_preview[i].active_voxels, of_clay[i + 1].active_voxels);
  }
  const std::uint64_t before = preview.clay().hash();
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_EQ(preview.clay().hash(), before);
}

/// What the servo's window of a tool this large asks for.
WindowRequest felt_at(const Vec3& place) {
  return {place, 0.25 * kPreviewToolMm, 1.5 * kPreviewToolMm, 9.0};
}

TEST(Preview, IsFeltAsTheClayIs) {
  Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  Preview preview = preview_of(clay, stroke);
  const WindowRequest request = felt_at(stroke.samples[3].position_mm);
  const auto before = read_window(clay, request, Extension::layers);
  const auto same = read_window(preview.clay(), request, Extension::layers);
  ASSERT_TRUE(before.ok() && same.ok());
  EXPECT_EQ(same.value().storage, before.value().storage);
  // The servo gets it from the same publisher as ever, ahead of the clay.
  WindowChannel channel;
  WindowPublisher publisher(channel);
  ASSERT_TRUE(preview.extend(stroke.samples).ok());
  ASSERT_TRUE(publisher.publish(preview.clay(), request).ok());
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  ASSERT_TRUE(clay.extend_stroke(stroke.samples).ok());
  const auto ahead = read_window(preview.clay(), request, Extension::layers);
  const auto after = read_window(clay, request, Extension::layers);
  ASSERT_TRUE(ahead.ok() && after.ok());
  double most = 0.0;
  double moved = 0.0;
  for (std::size_t i = 0; i < after.value().storage.size(); ++i) {
    const auto value = static_cast<double>(after.value().storage[i]);
    if (std::abs(value) > 2.0 * request.voxel_mm) continue;  // what the kernel's skin weighs
    most = std::max(most, std::abs(value - static_cast<double>(ahead.value().storage[i])));
    moved = std::max(moved, std::abs(value - static_cast<double>(before.value().storage[i])));
  }
  RecordProperty("most_of_spacing", std::to_string(most / request.voxel_mm));
  RecordProperty("moved_of_spacing", std::to_string(moved / request.voxel_mm));
  EXPECT_LT(most, 0.25 * request.voxel_mm);
  EXPECT_GT(moved, request.voxel_mm);
}

TEST(Preview, IsPickedAtOnce) {
  const Clay clay = fine_ball();
  const Stroke stroke = large_stroke(Action::carve);
  const Preview preview = previewed(clay, stroke);
  const Vec3 at = stroke.samples[4].position_mm;
  const Ray ray{2.0 * at, -at};
  const auto before = pick(clay, ray);
  const auto after = pick(preview.clay(), ray);
  ASSERT_TRUE(before.ok() && before.value() && after.ok() && after.value());
  EXPECT_GT(after.value()->distance_mm, before.value()->distance_mm + 0.5);
}

/// How far the surface of one clay lies from another, at most, in mm.
double farthest(const Clay& from, const Clay& to) {
  double most = 0.0;
  for (const Vec3& p : extract_surface(from).positions) {
    most = std::max(most, std::abs(to.distance_at(p)));
  }
  return most;
}

/// In voxels of the preview's level, both ways.
double miss(const Preview& preview, const Clay& clay) {
  return std::max(farthest(preview.clay(), clay), farthest(clay, preview.clay())) /
         voxel_of(preview);
}

class PreviewAccuracyOf : public testing::TestWithParam<Action> {};

/// Of tools whose previews are of level 1 and 2; usually one of them, the large one where a dab
/// costs least.
std::vector<double> radii_of(Action action) {
  const std::vector<double> all{kPreviewToolMm, 1.7 * kPreviewToolMm};
  const bool is_cheap =
      action == Action::add || action == Action::carve || action == Action::inflate;
  return effort(std::vector<double>{all[is_cheap ? 1 : 0]}, all);
}

/// Usually two or three dabs, fewest of what costs most.
int samples_of(Action action) { return effort(is_anchored(action) ? 2 : 3, kPreviewSamples); }

TEST_P(PreviewAccuracyOf, IsWithinAVoxelOfWhatTheClayBecomes) {
  // Their plane is fitted anew by every dab to what the dabs before left, and errors add up.
  const bool is_fitted = GetParam() == Action::flatten || GetParam() == Action::scrape;
  for (const double radius_mm : radii_of(GetParam())) {
    Clay clay = fine_ball();
    const std::uint64_t start = clay.hash();
    Stroke stroke = large_stroke(GetParam(), samples_of(GetParam()));
    stroke.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
    stroke.radial.count = 2;
    const Preview preview = previewed(clay, stroke);
    ASSERT_EQ(preview.level(), radius_mm == kPreviewToolMm ? 1 : 2);
    ASSERT_TRUE(clay.apply(stroke).ok());
    ASSERT_NE(clay.hash(), start);
    const double voxels = miss(preview, clay);
    RecordProperty("voxels_" + std::to_string(preview.level()), std::to_string(voxels));
    // A strip's sides are two voxels of level 2 wide and as high as ten dabs.
    const bool is_steep = GetParam() == Action::clay_strips && preview.level() == 2;
    const double most = is_steep ? 2.5 : is_fitted ? 1.5 : 1.0;
    EXPECT_LT(voxels, most) << "level " << preview.level();
  }
}

INSTANTIATE_TEST_SUITE_P(Actions, PreviewAccuracyOf, testing::ValuesIn(actions_on_levels()),
                         name_of);

TEST(PreviewAccuracy, HoldsMatterAsTheClayDoes) {
  Clay clay = fine_ball();
  Stroke held = large_stroke(Action::mask, 4);
  held.tool.radii_mm = {2.5, 2.5, 2.5};
  ASSERT_TRUE(clay.apply(held).ok());
  Stroke stroke = large_stroke(Action::carve, effort(4, kPreviewSamples));
  const Preview preview = previewed(clay, stroke);
  ASSERT_TRUE(preview.clay().has_mask());
  const Vec3 at = 0.99 * held.samples[1].position_mm;
  EXPECT_GT(clay.mask_at(at), 0.5);
  EXPECT_NEAR(preview.clay().mask_at(at), clay.mask_at(at), 0.1);
  Clay free = fine_ball();
  ASSERT_TRUE(free.apply(stroke).ok());
  ASSERT_TRUE(clay.apply(stroke).ok());
  // What is held stays, in both.
  EXPECT_GT(farthest(free, clay), 2.0 * voxel_of(preview));
  const double voxels = miss(preview, clay);
  RecordProperty("voxels", std::to_string(voxels));
  EXPECT_LT(voxels, 2.0);
}

TEST(PreviewAccuracy, HoldsWhereThereIsNoClayYet) {
  Clay clay = Clay::ball(4.0, ClayOptions{.voxel_mm = 0.1}).value();
  Stroke all = large_stroke(Action::carve, 1);
  all.tool.radii_mm = {8.0, 8.0, 8.0};
  all.tool.strength = 1.0;
  all.tool.pressure_to_strength = 0.0;
  all.samples[0].position_mm = {};
  Clay empty = Clay::ball(4.0, ClayOptions{.voxel_mm = 0.1}).value();
  ASSERT_TRUE(empty.apply(all).ok());
  ASSERT_TRUE(extract_surface(empty).positions.empty());
  const Stroke more = large_stroke(Action::add);
  const Preview nothing = previewed(empty, all);
  EXPECT_TRUE(nothing.changed().empty());
  const Preview preview = previewed(empty, more);
  EXPECT_FALSE(preview.changed().empty());
  ASSERT_TRUE(empty.apply(more).ok());
  EXPECT_LT(miss(preview, empty), 1.0);
}

}  // namespace
}  // namespace argil::test
