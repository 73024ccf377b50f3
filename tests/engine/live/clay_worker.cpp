// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/clay_worker.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "argil/engine/clay_thread.h"

namespace argil {
namespace {

Clay worked_ball() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::ball(10.0, options).value();
}

ClayWorkerOptions carver() {
  ClayWorkerOptions options;
  options.tool = {Action::carve, Shape::ball, {3, 3, 3}, 1.0};
  return options;
}

/// Sample `index` of a hand that goes round the ball's equator, 5 ms apart.
ToolSample sample_of(std::uint64_t index, bool is_active) {
  ToolSample sample;
  sample.index = index;
  sample.time_s = 0.005 * static_cast<double>(index);
  const double a = 0.02 * static_cast<double>(index);
  sample.position_mm = {10.0 * std::cos(a), 10.0 * std::sin(a), 0.0};
  sample.pressure = 1.0;
  sample.is_active = is_active;
  sample.voxel_mm = 0.75;
  sample.reach_mm = 8.0;
  sample.depth_mm = 12.0;
  return sample;
}

Stroke stroke_of(std::uint64_t first, std::uint64_t last) {
  Stroke stroke;
  stroke.tool = carver().tool;
  for (std::uint64_t n = first; n <= last; ++n) {
    const ToolSample s = sample_of(n, true);
    stroke.samples.push_back({s.time_s, s.position_mm, s.orientation, s.pressure});
  }
  return stroke;
}

struct Rig {
  explicit Rig(const ClayWorkerOptions& options = carver(), std::size_t capacity = 64)
      : ring(capacity), worker(clay, options, ring, channel) {}

  /// Samples `first` to `last`; false when the ring dropped one.
  bool push(std::uint64_t first, std::uint64_t last, bool is_active) {
    bool all = true;
    for (std::uint64_t n = first; n <= last; ++n) all = ring.push(sample_of(n, is_active)) && all;
    return all;
  }
  const WindowSlot& newest() {
    channel.fetch();
    return channel.read_slot();
  }

  Clay clay = worked_ball();
  ToolSampleRing ring;
  WindowChannel channel;
  ClayWorker worker;
};

TEST(ClayWorker, DoesNothingWhenNothingWaits) {
  Rig rig;
  EXPECT_FALSE(rig.worker.step().value());
  EXPECT_EQ(rig.newest().sequence, 0U);
  EXPECT_FALSE(rig.worker.finish().value());
}

/// Two runs of active samples, cut by the steps in the midst of the first: the bits of the two
/// strokes given whole, and an undo step for each.
TEST(ClayWorker, MakesAStrokeOfEachActiveRun) {
  Rig rig;
  ASSERT_TRUE(rig.push(1, 3, false) && rig.push(4, 9, true));
  ASSERT_TRUE(rig.worker.step().ok());
  EXPECT_TRUE(rig.clay.is_stroke_open());
  ASSERT_TRUE(rig.push(10, 20, true) && rig.push(21, 22, false) && rig.push(23, 30, true));
  ASSERT_TRUE(rig.worker.step().ok());
  ASSERT_TRUE(rig.worker.finish().value());
  EXPECT_FALSE(rig.clay.is_stroke_open());
  EXPECT_EQ(rig.worker.counts().strokes, 2U);
  EXPECT_EQ(rig.worker.counts().samples, 30U);
  Clay whole = worked_ball();
  int dabs = 0;
  for (const Stroke& stroke : {stroke_of(4, 20), stroke_of(23, 30)}) {
    const auto report = whole.apply(stroke);
    ASSERT_TRUE(report.ok());
    dabs += report.value().dabs;
  }
  EXPECT_EQ(rig.clay.hash(), whole.hash());
  EXPECT_EQ(rig.worker.counts().dabs, static_cast<std::uint64_t>(dabs));
  EXPECT_EQ(rig.clay.undo_depth(), 2);
}

/// Two runs, the first in pieces, then one beside the clay's reach that fails in its midst, and one
/// that meets nothing at no pressure.
TEST(ClayWorker, TellsStrokesThatApplyTheSame) {
  std::vector<Stroke> told;
  ClayWorkerOptions options = carver();
  options.style.spacing = 0.5;
  options.style.mirror.x = true;
  options.on_stroke = [&](const Stroke& stroke) { told.push_back(stroke); };
  Rig rig(options);
  ASSERT_TRUE(rig.push(1, 9, true));
  ASSERT_TRUE(rig.worker.step().ok());
  EXPECT_TRUE(told.empty()) << "the stroke is not finished";
  ASSERT_TRUE(rig.push(10, 15, true) && rig.push(16, 17, false) && rig.push(18, 25, true));
  ASSERT_TRUE(rig.worker.step().ok());
  EXPECT_EQ(told.size(), 1U);
  ToolSample far = sample_of(26, true);
  far.position_mm.x = 1e9;
  ASSERT_TRUE(rig.ring.push(far));
  EXPECT_FALSE(rig.worker.step().ok());
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].samples.size(), 8U);
  ToolSample weak = sample_of(27, true);
  weak.position_mm = {50.0, 0.0, 0.0};
  ASSERT_TRUE(rig.ring.push(weak));
  ASSERT_TRUE(rig.worker.step().ok() && rig.worker.finish().ok());
  Clay whole = worked_ball();
  for (const Stroke& stroke : told) ASSERT_TRUE(whole.apply(stroke).ok());
  EXPECT_EQ(rig.clay.hash(), whole.hash());
  EXPECT_EQ(rig.clay.undo_depth(), whole.undo_depth());
  EXPECT_EQ(rig.worker.counts().strokes, told.size());
}

TEST(ClayWorker, StopsAtTheIndexAReplayNames) {
  Rig rig;
  ASSERT_TRUE(rig.push(1, 10, false));
  ASSERT_TRUE(rig.worker.step(4).value());
  EXPECT_EQ(rig.newest().answers, 4U);
  EXPECT_EQ(rig.worker.counts().samples, 4U);
  EXPECT_FALSE(rig.worker.step(4).value());
  ASSERT_TRUE(rig.worker.step().value());
  EXPECT_EQ(rig.worker.counts().samples, 10U);
}

TEST(ClayWorker, AnswersWithTheWindowOfTheNewestSample) {
  Rig rig;
  ASSERT_TRUE(rig.push(1, 7, true));
  ASSERT_TRUE(rig.worker.step().value());
  const WindowSlot& slot = rig.newest();
  EXPECT_EQ(slot.answers, 7U);
  EXPECT_EQ(slot.time_s, sample_of(7, true).time_s);
  EXPECT_EQ(slot.sequence, 1U);
  EXPECT_EQ(window_checksum(slot.view()), slot.checksum);
  const ToolSample newest = sample_of(7, true);
  const auto read =
      read_window(rig.clay, {newest.position_mm, newest.voxel_mm, newest.reach_mm, newest.depth_mm},
                  Extension::layers);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(window_checksum(read.value().view), slot.checksum);
}

/// Rests: no window but for the refresh. Drift, another request, an edit: a window.
TEST(ClayWorker, PublishesWhenTheServoNeedsIt) {
  ClayWorkerOptions options = carver();
  options.drift_voxels = 1.0;
  options.refresh_s = 0.05;
  Rig rig(options);
  ToolSample sample = sample_of(1, false);
  const auto windows_after = [&](double later_s) {
    ++sample.index;
    sample.time_s += later_s;
    EXPECT_TRUE(rig.ring.push(sample));
    EXPECT_TRUE(rig.worker.step().ok());
    return rig.worker.counts().windows;
  };
  EXPECT_EQ(windows_after(0.001), 1U);
  EXPECT_EQ(windows_after(0.001), 1U);
  sample.position_mm.x += 0.7;
  EXPECT_EQ(windows_after(0.001), 1U);
  sample.position_mm.x += 0.1;
  EXPECT_EQ(windows_after(0.001), 2U);
  sample.depth_mm += 1.0;
  EXPECT_EQ(windows_after(0.001), 3U);
  EXPECT_EQ(windows_after(0.06), 4U);
  ASSERT_TRUE(rig.clay.apply(stroke_of(1, 4)).ok());
  EXPECT_EQ(windows_after(0.001), 5U);
  ASSERT_TRUE(rig.clay.undo());
  EXPECT_EQ(windows_after(0.001), 6U);
  EXPECT_EQ(windows_after(0.001), 6U);
}

TEST(ClayWorker, GoesOnAfterAWindowThatCannotBe) {
  Rig rig;
  ToolSample far = sample_of(1, false);
  far.position_mm = {1e9, 0, 0};
  const std::uint64_t before = rig.clay.hash();
  ASSERT_TRUE(rig.ring.push(far));
  const auto refused = rig.worker.step();
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_NE(refused.error().message.find("move the tool nearer"), std::string::npos);
  EXPECT_EQ(rig.clay.hash(), before);
  EXPECT_EQ(rig.newest().sequence, 0U);
  ASSERT_TRUE(rig.push(2, 2, false));
  EXPECT_TRUE(rig.worker.step().value());
  EXPECT_EQ(rig.newest().answers, 2U);
}

/// What was carved before the bad sample stays as one stroke; the next good one begins another.
TEST(ClayWorker, GoesOnAfterASampleThatCannotBeApplied) {
  Rig rig;
  ASSERT_TRUE(rig.push(1, 10, true));
  ASSERT_TRUE(rig.worker.step().ok());
  ToolSample bad = sample_of(11, true);
  bad.orientation.w = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(rig.ring.push(bad));
  const auto refused = rig.worker.step();
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("not finite"), std::string::npos);
  EXPECT_FALSE(rig.clay.is_stroke_open());
  Clay whole = worked_ball();
  ASSERT_TRUE(whole.apply(stroke_of(1, 10)).ok());
  EXPECT_EQ(rig.clay.hash(), whole.hash());
  ASSERT_TRUE(rig.push(12, 14, true));
  EXPECT_TRUE(rig.worker.step().ok());
  EXPECT_TRUE(rig.worker.finish().value());
  EXPECT_EQ(rig.clay.undo_depth(), 2);
  EXPECT_TRUE(rig.clay.validate().empty());
}

TEST(ClayWorker, SaysWhatIsWrongWithItsTool) {
  ClayWorkerOptions options = carver();
  options.tool.radii_mm = {-1, -1, -1};
  Rig rig(options);
  ASSERT_TRUE(rig.push(1, 3, true));
  const auto refused = rig.worker.step();
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("radius_mm is -1"), std::string::npos);
  EXPECT_EQ(rig.newest().answers, 3U);  // it can still be felt
}

/// A stroke through a ring that drops its middle is a straight way there, and nothing is lost
/// after.
TEST(ClayWorker, TakesAGapOfDroppedSamplesAsAStraightWay) {
  Rig rig(carver(), 8);
  EXPECT_FALSE(rig.push(1, 12, true));
  EXPECT_EQ(rig.ring.dropped(), 4U);
  ASSERT_TRUE(rig.worker.step().ok());
  ASSERT_TRUE(rig.push(13, 15, true) && rig.push(16, 16, false));
  ASSERT_TRUE(rig.worker.step().ok());
  Stroke with_gap = stroke_of(1, 15);
  with_gap.samples.erase(with_gap.samples.begin() + 8, with_gap.samples.begin() + 12);
  Clay whole = worked_ball();
  ASSERT_TRUE(whole.apply(with_gap).ok());
  EXPECT_EQ(rig.clay.hash(), whole.hash());
}

TEST(ClayThread, TakesWhatWaitsAndEndsTheStrokeWhenStopped) {
  Rig rig;
  ClayHeartbeat heartbeat;
  auto started = ClayThread::start(rig.worker, heartbeat);
  ASSERT_TRUE(started.ok());
  EXPECT_TRUE(heartbeat.alive);
  ASSERT_TRUE(rig.push(1, 20, true));
  EXPECT_TRUE(started.value()->stop().ok());
  EXPECT_FALSE(heartbeat.alive);
  EXPECT_GT(heartbeat.beats, 0U);
  EXPECT_TRUE(started.value()->stop().ok());
  EXPECT_FALSE(rig.clay.is_stroke_open());
  Clay whole = worked_ball();
  ASSERT_TRUE(whole.apply(stroke_of(1, 20)).ok());
  EXPECT_EQ(rig.clay.hash(), whole.hash());
}

TEST(ClayThread, ShowsThatItDiedAndTellsWhy) {
  Rig rig;
  ClayHeartbeat heartbeat;
  auto started = ClayThread::start(rig.worker, heartbeat);
  ASSERT_TRUE(started.ok());
  ToolSample far = sample_of(1, false);
  far.position_mm = {1e9, 0, 0};
  ASSERT_TRUE(rig.ring.push(far));
  while (heartbeat.alive) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto stopped = started.value()->stop();
  ASSERT_FALSE(stopped.ok());
  EXPECT_NE(stopped.error().message.find("move the tool nearer"), std::string::npos);
  EXPECT_FALSE(started.value()->stop().ok());
}

}  // namespace
}  // namespace argil
