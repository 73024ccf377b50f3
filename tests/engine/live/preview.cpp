// SPDX-License-Identifier: GPL-3.0-or-later
// A preview beside the clay it is of: the clay must not notice it, and it must not be far from what
// the clay becomes.
#include "argil/engine/preview.h"

#include <algorithm>
#include <cmath>
#include <map>
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

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "live/sketch_blocks.h"
#include "support/bumpy_clay.h"
#include "support/drawn_copies.h"
#include "support/effort.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

/// Its finest level is everywhere.
constexpr double kPreviewBallMm = 7.0;
constexpr double kPreviewVoxelMm = 0.1;
Clay fine_ball() {
  auto made = bumpy_ball(kPreviewBallMm, kPreviewVoxelMm);
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

/// For a tool of 4 mm, 40 voxels, the preview is of level 1 with half as many voxels as usual.
constexpr double kPreviewToolMm = 4.0;
constexpr double kPreviewToolVoxels = 32.0;
constexpr int kSamples = 10;
Stroke large_stroke(Action action, int most_samples = kSamples) {
  Stroke stroke;
  // What is anchored moves all its way with each dab.
  const int samples = std::min(most_samples, is_anchored(action) ? 4 : kSamples);
  stroke.tool.action = action;
  stroke.tool.radii_mm = {kPreviewToolMm, kPreviewToolMm, kPreviewToolMm};
  stroke.tool.pressure_to_strength = 0.3;
  const double away = action == Action::carve ? kPreviewBallMm + 2.0 : kPreviewBallMm;
  for (int i = 0; i < samples; ++i) {
    const double turn = 0.12 * i;
    StrokeSample sample;
    sample.time_s = 0.01 * i;
    sample.position_mm = {away * std::cos(turn), away * std::sin(turn), 0.2 * i};
    sample.pressure = 0.6 + 0.04 * i;
    stroke.samples.push_back(sample);
  }
  return stroke;
}

/// What is drawn of a clay; of most of these tests, nothing.
DisplaySurface drawn_of(const Clay& clay) {
  DisplaySurface surface;
  EXPECT_TRUE(surface.update(clay).ok());
  return surface;
}
const DisplaySurface& not_drawn() {
  static const DisplaySurface nothing;
  return nothing;
}

Result<std::optional<Preview>> begin_preview(const Clay& clay, const Tool& tool,
                                             const StrokeStyle& style = {},
                                             double tool_voxels = kPreviewToolVoxels) {
  return Preview::begin(clay, not_drawn(), tool, style, tool_voxels);
}

Preview preview_of(const Clay& clay, const Stroke& stroke,
                   const DisplaySurface& shown = not_drawn()) {
  auto made = Preview::begin(clay, shown, stroke.tool, stroke, kPreviewToolVoxels);
  EXPECT_TRUE(made.ok());
  EXPECT_TRUE(made.value().has_value());
  return std::move(*made.value());
}

/// The preview after all of a stroke.
Preview previewed(const Clay& clay, const Stroke& stroke) {
  Preview preview = preview_of(clay, stroke);
  EXPECT_TRUE(preview.extend(stroke.samples).ok());
  EXPECT_TRUE(preview.end().ok());
  EXPECT_TRUE(preview.update_surface().ok());
  return preview;
}

double voxel_of(const Preview& preview) { return preview.clay().options().voxel_mm; }

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
  Stroke stroke = large_stroke(GetParam(), effort(is_anchored(GetParam()) ? 3 : 5, kSamples));
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
  EXPECT_EQ(level_for({95.9, 95.9, 95.9}), 0);
  EXPECT_EQ(level_for({97, 97, 97}), 1);
  EXPECT_EQ(level_for({191, 191, 191}), 1);
  EXPECT_EQ(level_for({193, 193, 193}), 2);
  EXPECT_EQ(level_for({1e4, 1e4, 1e4}), clay.level_count() - 1);
  // Where the clay writes a flat tool the preview does as well.
  EXPECT_EQ(level_for({193, 193, 17}), 1);
  EXPECT_EQ(level_for({193, 193, 9}), 0);
  // What is solved anew under the tool costs more.
  tool.action = Action::smooth;
  EXPECT_EQ(level_for({31.9, 31.9, 31.9}), 0);
  EXPECT_EQ(level_for({33, 33, 33}), 1);
  EXPECT_EQ(level_for({65, 65, 65}), 2);
  tool.radii_mm = {4.0, 4.0, 4.0};
  EXPECT_EQ(Preview::level_of(clay, tool, 40.1), 0);
  EXPECT_EQ(Preview::level_of(clay, tool, 19.9), 2);
}

TEST(Preview, IsNotMadeForASmallToolNorForAMask) {
  const Clay clay = fine_ball();
  Tool tool;
  tool.radii_mm = {9.5, 9.5, 9.5};
  const auto of_small = Preview::begin(clay, not_drawn(), tool);
  ASSERT_TRUE(of_small.ok());
  EXPECT_FALSE(of_small.value().has_value());
  tool.radii_mm = {9.7, 9.7, 9.7};
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
int samples_of(Action action) {
  const bool is_dear = is_anchored(action) || action == Action::crease;
  return effort(is_dear ? 2 : 3, kSamples);
}

TEST_P(PreviewAccuracyOf, IsWithinAVoxelOfWhatTheClayBecomes) {
  // Their plane is fitted anew by every dab to what the dabs before left, and errors add up.
  const bool is_fitted = GetParam() == Action::flatten || GetParam() == Action::scrape;
  const double most = is_fitted ? 1.5 : 1.0;
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
  Stroke stroke = large_stroke(Action::carve, effort(4, kSamples));
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

DrawnCopy copy_of(const DisplayBlock& block) {
  return {{block.vertices.begin(), block.vertices.end()},
          {block.triangles.begin(), block.triangles.end()}};
}

DrawnCopies copies_of(const DisplaySurface& surface) {
  DrawnCopies copies;
  for (const BlockId& id : surface.blocks()) copies[id] = copy_of(surface.block(id));
  return copies;
}

/// What a renderer does with the lists of an update. Every block that is to go is there.
void follow(DrawnCopies& copies, const Preview& preview) {
  for (const BlockId& id : preview.gone()) EXPECT_EQ(copies.erase(id), 1U);
  for (const BlockId& id : preview.changed()) {
    const DisplayBlock block = preview.block(id);
    EXPECT_FALSE(block.triangles.empty());
    for (const DisplayVertex& v : block.vertices) {
      const auto& p = v.position_mm;
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_LE(block.bounds_mm.min[a], double{p[a]});
        EXPECT_GE(block.bounds_mm.max[a], double{p[a]});
      }
    }
    copies[id] = copy_of(block);
  }
}

/// Extends, updates and follows.
void follow(DrawnCopies& copies, Preview& preview, std::span<const StrokeSample> samples) {
  ASSERT_TRUE(preview.extend(samples).ok());
  ASSERT_TRUE(preview.update_surface().ok());
  follow(copies, preview);
}

/// How many edges do not have as many triangles on one side as on the other, vertices merged by
/// the bits of their positions. Where a seam folds onto itself an edge may have four.
std::int64_t open_edges(const DrawnCopies& copies) {
  const TriangleMesh mesh = welded(copies);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (a != b) sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::count_if(sides.begin(), sides.end(),
                       [](const auto& side) { return side.second != 0; });
}

class PreviewSurfaceOf : public testing::TestWithParam<Action> {};

TEST_P(PreviewSurfaceOf, IsClosedAndBackAsItWasAtAnyMomentOfAStroke) {
  Stroke stroke = large_stroke(GetParam(), effort(is_anchored(GetParam()) ? 3 : 5, kSamples));
  stroke.mirror.z = true;
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  const DrawnCopies before = copies_of(shown);
  Preview preview = preview_of(clay, stroke, shown);
  DrawnCopies drawn = before;
  for (const StrokeSample& sample : stroke.samples) {
    follow(drawn, preview, {&sample, 1});
    EXPECT_EQ(open_edges(drawn), 0);
  }
  EXPECT_FALSE(drawn == before);
  ASSERT_TRUE(preview.end().ok());
  ASSERT_TRUE(preview.update_surface().ok());
  follow(drawn, preview);
  EXPECT_EQ(open_edges(drawn), 0);
  // It lies where the preview is, but for the detail that only the clay has.
  double most = 0.0;
  for (const auto& [id, copy] : drawn) {
    for (const DisplayVertex& v : copy.vertices) {
      const auto& p = v.position_mm;
      most = std::max(
          most, std::abs(preview.clay().distance_at({double{p[0]}, double{p[1]}, double{p[2]}})));
    }
  }
  RecordProperty("voxels", std::to_string(most / voxel_of(preview)));
  EXPECT_LT(most, voxel_of(preview));
}

INSTANTIATE_TEST_SUITE_P(Actions, PreviewSurfaceOf, testing::ValuesIn(actions_on_levels()),
                         name_of);

/// A view that draws most of the clay coarser than the preview is.
TEST(PreviewSurface, IsClosedWhereTheClayIsDrawnCoarser) {
  const Clay clay = fine_ball();
  DisplayView far;
  far.eye_mm = {60.0, 0.0, 0.0};
  far.pixel_mm = 3.0 * kPreviewVoxelMm;
  for (const Action action : {Action::carve, Action::inflate, Action::grab}) {
    DisplaySurface shown;
    ASSERT_TRUE(shown.update(clay, far).ok());
    ASSERT_GT(shown.stats().hidden_leaves, 0);
    const Stroke stroke = large_stroke(action, 3);
    Preview preview = preview_of(clay, stroke, shown);
    // Level 1 is hidden: what makes surface is shown at level 2.
    EXPECT_EQ(preview.level(), action == Action::inflate ? 1 : 2);
    DrawnCopies drawn = copies_of(shown);
    for (const StrokeSample& sample : stroke.samples) {
      follow(drawn, preview, {&sample, 1});
      EXPECT_EQ(open_edges(drawn), 0);
    }
    EXPECT_FALSE(drawn == copies_of(shown));
  }
}

TEST(PreviewSurface, MakesNoPreviewWhereTheClayIsDrawnTooCoarseForTheTool) {
  const Clay clay = fine_ball();
  DisplayView far;
  far.eye_mm = {600.0, 0.0, 0.0};
  far.pixel_mm = 40.0 * kPreviewVoxelMm;
  far.coarser = 32;
  DisplaySurface shown;
  ASSERT_TRUE(shown.update(clay, far).ok());
  Stroke stroke = large_stroke(Action::carve, 1);
  const auto made = Preview::begin(clay, shown, stroke.tool, stroke, kPreviewToolVoxels);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(made.value().has_value());
}

/// The seam lies on both surfaces, where they run side by side.
TEST(PreviewSurface, HasASeamOfHalfAVoxelAtMost) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  for (const Action action : {Action::carve, Action::add, Action::grab}) {
    const Stroke stroke = large_stroke(action);
    Preview preview = preview_of(clay, stroke, shown);
    ASSERT_TRUE(preview.extend(stroke.samples).ok());
    ASSERT_TRUE(preview.update_surface().ok());
    double most = 0.0;
    int count = 0;
    for (const BlockId& id : preview.changed()) {
      if (id.origin[0] % kLeafSide == 0) continue;
      for (const DisplayVertex& v : preview.block(id).vertices) {
        const Vec3 p{double{v.position_mm[0]}, double{v.position_mm[1]}, double{v.position_mm[2]}};
        most = std::max(
            {most, std::abs(clay.distance_at(p)), std::abs(preview.clay().distance_at(p))});
        ++count;
      }
    }
    EXPECT_GT(count, 300);
    RecordProperty("voxels_" + std::to_string(static_cast<int>(action)),
                   std::to_string(most / voxel_of(preview)));
    EXPECT_LT(most, 0.5 * voxel_of(preview));
  }
}

/// What moves is a matter of the vertex and the preview alone.
TEST(PreviewSurface, HasTheSameBitsWhateverUpdatesLedThere) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  for (const Action action : {Action::inflate, Action::smooth, Action::carve}) {
    const Stroke stroke = large_stroke(action, 4);
    Preview often = preview_of(clay, stroke, shown);
    DrawnCopies drawn = copies_of(shown);
    for (const StrokeSample& sample : stroke.samples) follow(drawn, often, {&sample, 1});
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Preview once = preview_of(clay, stroke, shown);
    DrawnCopies at_once = copies_of(shown);
    follow(at_once, once, stroke.samples);
    EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(at_once));
  }
}

/// A clay remembers 65 536 changes of leaves; each of these samples makes about 700.
void expect_made_anew_after(int samples) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  Stroke stroke = large_stroke(Action::inflate, 1);
  stroke.tool.radii_mm = {6.3, 6.3, 6.3};
  stroke.tool.strength = 0.05;
  Preview seldom = preview_of(clay, stroke, shown);
  Preview often = preview_of(clay, stroke, shown);
  DrawnCopies drawn = copies_of(shown);
  DrawnCopies again = drawn;
  StrokeSample sample = stroke.samples[0];
  for (int i = 0; i < samples; ++i) {
    sample.time_s += 0.01;
    sample.position_mm.y = i % 2 == 0 ? 2.0 : -2.0;
    ASSERT_TRUE(seldom.extend({&sample, 1}).ok());
    follow(again, often, {&sample, 1});
  }
  ASSERT_TRUE(seldom.update_surface().ok());
  follow(drawn, seldom);
  EXPECT_TRUE(drawn == again);
}

TEST(PreviewSurface, IsMadeAnewWhenMoreChangedThanTheClayRemembers) { expect_made_anew_after(112); }

TEST(PreviewSurfaceSlow, IsMadeAnewWhenMoreChangedThanTheClayRemembers) {
  expect_made_anew_after(150);
}

/// The same of blocks in the place of the clay's: from then on all are.
TEST(PreviewSurface, TakesTheWholePlaceOfTheClayWhenItIsNotKnownWhatChanged) {
  const Clay clay = fine_ball();
  const DisplaySurface shown = drawn_of(clay);
  const auto coarse = [&] {
    return clay_of_levels(levels_of(clay).copy_from(1),
                          ClayOptions{.voxel_mm = 2.0 * kPreviewVoxelMm});
  };
  const Clay before = coarse();
  Clay now = coarse();
  SketchBlocks blocks(shown, before, now, 1);
  DrawnCopies drawn = copies_of(shown);
  const auto update = [&](const std::optional<std::vector<LeafChange>>& changes) {
    BlockLists lists;
    blocks.update(changes, lists);
    for (const BlockId& id : lists.gone) drawn.erase(id);
    for (const BlockId& id : lists.changed) drawn[id] = copy_of(blocks.block(id));
    EXPECT_EQ(open_edges(drawn), 0);
  };
  const auto carve = [&](double from, double to) {
    const std::uint64_t known = revision(now);
    EXPECT_TRUE(
        now.apply(stroke_of(Action::carve, 3.0, 1.0, {{from, 6.0, 0.0}, {to, 6.0, 0.0}})).ok());
    return changes_since(now, known);
  };
  update(carve(-1.0, 0.0));
  EXPECT_FALSE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
  carve(0.0, 1.0);
  update(std::nullopt);
  EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
  update(carve(1.0, 2.0));
  EXPECT_TRUE(sorted_triangles(drawn) == sorted_triangles(extract_surface(now)));
}

/// Bumps of 0.6 voxel, 10 voxels long, on a ball, and a tool of 120 voxels that works over it.
class PreviewDetailOf : public testing::TestWithParam<Action> {
 protected:
  static constexpr double kBallMm = 40.0;
  static constexpr double kVoxelMm = 0.25;
  static constexpr double kToolMm = 120.0 * kVoxelMm;
  static constexpr double kHeightMm = 0.6 * kVoxelMm;

  static double pattern_mm(const Vec3& on_ball) {
    constexpr double kTurn = 2.0 * 3.141592653589793 / (10.0 * kVoxelMm);
    return kHeightMm * std::sin(kTurn * on_ball.x) * std::sin(kTurn * on_ball.y) *
           std::sin(kTurn * on_ball.z);
  }
  static Clay ball_with_detail() {
    const double half = kBallMm + kHeightMm + 1.0;
    const auto distance = [](const Vec3& p) {
      const double r = length(p);
      return r < 1e-6 ? -kBallMm : r - kBallMm - pattern_mm((kBallMm / r) * p);
    };
    return Clay::from_distance(distance, {{-half, -half, -half}, {half, half, half}},
                               ClayOptions{.voxel_mm = kVoxelMm})
        .value();
  }
  static Stroke stroke() {
    Stroke stroke;
    stroke.tool.action = GetParam();
    stroke.tool.radii_mm = {kToolMm, kToolMm, kToolMm};
    stroke.tool.strength = is_stamped(GetParam()) ? 1.0 : 0.3;
    for (const double turn : {-0.2, 0.0, 0.2}) {
      StrokeSample sample;
      sample.time_s = 1.0 + turn;
      sample.position_mm = {kBallMm * std::sin(turn), -kBallMm * std::cos(turn), 0.7};
      stroke.samples.push_back(sample);
    }
    return stroke;
  }
  /// From the way of the tool's middle, in its radii.
  static double radii_from(const Stroke& stroke, const Vec3& p) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < stroke.samples.size(); ++i) {
      const Vec3 from = stroke.samples[i].position_mm;
      const Vec3 way = stroke.samples[i + 1].position_mm - from;
      const double t = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
      nearest = std::min(nearest, length(p - from - t * way));
    }
    return nearest / kToolMm;
  }
  /// How much of the pattern's height is drawn beside the tool.
  static double drawn_beside(const DrawnCopies& drawn, const Stroke& stroke) {
    double found = 0.0;
    double all = 0.0;
    for (const auto& [id, copy] : drawn) {
      for (const DisplayVertex& v : copy.vertices) {
        const auto& p = v.position_mm;
        const Vec3 at{double{p[0]}, double{p[1]}, double{p[2]}};
        const Vec3 on_ball = (kBallMm / length(at)) * at;
        const double radii = radii_from(stroke, on_ball);
        // What was added or carved away there has no pattern.
        const bool is_on_ball = std::abs(length(at) - kBallMm) < 3.0 * kHeightMm;
        if (radii < 1.0 || radii > 1.3 || !is_on_ball) continue;
        const double wanted = pattern_mm(on_ball);
        found += (length(at) - kBallMm) * wanted;
        all += wanted * wanted;
      }
    }
    return found / all;
  }
};

TEST_P(PreviewDetailOf, IsDrawnBesideTheTool) {
  const Clay clay = ball_with_detail();
  const DisplaySurface shown = drawn_of(clay);
  const Stroke work = stroke();
  auto made = Preview::begin(clay, shown, work.tool, work);
  ASSERT_TRUE(made.ok() && made.value().has_value());
  Preview& preview = *made.value();
  DrawnCopies drawn = copies_of(shown);
  const double before = drawn_beside(drawn, work);
  EXPECT_GT(before, 0.95);
  for (const StrokeSample& sample : work.samples) {
    follow(drawn, preview, {&sample, 1});
    EXPECT_GT(drawn_beside(drawn, work), 0.95);
  }
  RecordProperty("before", std::to_string(before));
  RecordProperty("while_working", std::to_string(drawn_beside(drawn, work)));
  EXPECT_FALSE(drawn == copies_of(shown));
  EXPECT_EQ(open_edges(drawn), 0);
}

INSTANTIATE_TEST_SUITE_P(Actions, PreviewDetailOf,
                         testing::Values(Action::smooth, Action::inflate, Action::flatten,
                                         Action::layer, Action::add, Action::carve, Action::grab),
                         name_of);

}  // namespace
}  // namespace argil::test
