// SPDX-License-Identifier: GPL-3.0-or-later
// The clay in the servo's loop without a device: a prescribed hand feels and carves it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <gtest/gtest.h>

#include "argil/engine/clay_thread.h"
#include "argil/engine/clay_worker.h"
#include "argil/engine/surface.h"
#include "argil/haptics/scene/scene_clay.h"

#include "support/effort.h"
#include "support/realtime_counters.h"

namespace argil {
namespace {

using haptics::ClayScene;
using haptics::ClaySceneOptions;
using haptics::HandleState;
using haptics::SceneForce;

constexpr double kBallMm = 15.0;
constexpr double kToolMm = 3.0;

Clay clay_ball_in_loop() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::ball(kBallMm, options).value();
}

ClaySceneOptions scene_options() {
  ClaySceneOptions options;
  options.tool.radii_mm = {kToolMm, kToolMm, kToolMm};
  options.offset_mm = {0, 0, kBallMm};  // the device's middle is the top of the ball
  return options;
}

ClayWorkerOptions worker_options() {
  ClayWorkerOptions options;
  options.tool = {Action::carve, Shape::ball, {kToolMm, kToolMm, kToolMm}, 1.0};
  return options;
}

/// Comes down from above for 0.2 s, carves a groove over the top for 0.4 s, lifts off again.
HandleState hand_at(double time_s) {
  const double way = std::clamp((time_s - 0.2) / 0.4, 0.0, 1.0);
  const double lifted = 4.0 * std::max(0.0, std::abs(time_s - 0.4) - 0.2) / 0.2;
  HandleState handle;
  handle.time_s = time_s;
  handle.position_mm = {8.0 * (way - 0.5), 0.5 * std::sin(12.0 * way), 1.0 + lifted};
  if (way > 0.0 && way < 1.0) handle.velocity_mm_per_s = {20.0, 15.0 * std::cos(12.0 * way), 0.0};
  handle.is_active = way > 0.0 && way < 1.0;
  return handle;
}

/// What a run of 0.8 s left and felt.
struct LoopRun {
  double carved_mm3 = 0.0;
  double largest_n = 0.0;
  bool is_finite = true;
  std::uint32_t faults = 0;  ///< after the first window
  std::uint64_t dropped = 0;
  ClayWorkerCounts counts;
};

/// On virtual time: `rate_hz` ticks a second, the clay stepped every `clay_period_s`.
LoopRun run_loop(int rate_hz, double clay_period_s, std::size_t ring_capacity) {
  Clay clay = clay_ball_in_loop();
  const double before = signed_volume(extract_surface(clay));
  ToolSampleRing ring(ring_capacity);
  WindowChannel channel;
  ClayWorker worker(clay, worker_options(), ring, channel);
  ClayScene scene(scene_options(), ring, channel);
  const int ticks_per_step = static_cast<int>(std::lround(clay_period_s * rate_hz));
  LoopRun run;
  for (int tick = 0; tick <= rate_hz * 8 / 10; ++tick) {
    const HandleState handle = hand_at(static_cast<double>(tick) / rate_hz);
    scene.begin_tick(handle);
    scene.end_tick(handle);
    for (int query = 0; query < scene.most_queries(); query += 4) {
      HandleState place = handle;
      place.position_mm.z += 0.1 * query;
      const SceneForce force = scene.force_at(place);
      run.is_finite = run.is_finite && is_finite(force.force_n);
      run.largest_n = std::max(run.largest_n, length(force.force_n));
      if (tick > ticks_per_step) run.faults |= force.faults;
    }
    if (tick % ticks_per_step == 0) {
      EXPECT_TRUE(worker.step().ok());
    }
  }
  EXPECT_TRUE(worker.finish().ok());
  EXPECT_TRUE(clay.validate().empty());
  EXPECT_EQ(clay.undo_depth(), static_cast<int>(worker.counts().strokes));
  run.carved_mm3 = before - signed_volume(extract_surface(clay));
  run.dropped = scene.dropped();
  run.counts = worker.counts();
  return run;
}

TEST(ClayInLoop, CarvesTheSameAtAnyRate) {
  const double clay_period_s = test::effort(0.016, 0.01);  // a window each time, which costs
  const LoopRun slow = run_loop(1000, clay_period_s, 64);
  const LoopRun fast = run_loop(4000, clay_period_s, 64);
  std::printf("carved %.3f mm3 at 1 kHz, %.3f at 4 kHz; largest force %.3f and %.3f N\n",
              slow.carved_mm3, fast.carved_mm3, slow.largest_n, fast.largest_n);
  EXPECT_GT(slow.carved_mm3, 30.0);
  EXPECT_NEAR(fast.carved_mm3 / slow.carved_mm3, 1.0, 0.02);
  for (const LoopRun& run : {slow, fast}) {
    EXPECT_TRUE(run.is_finite);
    EXPECT_EQ(run.faults, 0U);
    EXPECT_EQ(run.dropped, 0U);
    EXPECT_EQ(run.counts.strokes, 1U);
    EXPECT_GT(run.largest_n, 1.0);
    EXPECT_LT(run.largest_n, 9.0);
    EXPECT_GT(run.counts.windows, 20U);
  }
}

/// A clay that comes by too seldom for its ring: samples are lost, the groove is cut straighter,
/// and everything goes on.
TEST(ClayInLoop, GoesOnWhenTheRingIsFull) {
  const LoopRun run = run_loop(1000, 0.08, 8);
  EXPECT_GT(run.dropped, 50U);
  EXPECT_TRUE(run.is_finite);
  EXPECT_EQ(run.faults & haptics::kSceneClayStopped, 0U);
  EXPECT_GT(run.carved_mm3, 30.0);
  EXPECT_GE(run.counts.strokes, 1U);
}

/// The device is lost on one side of the ball while it carves and comes back on the other.
TEST(ClayInLoop, CutsNothingBetweenWhereTheDeviceWasLostAndWhereItIsBack) {
  Clay clay = clay_ball_in_loop();
  const Vec3 top{0.0, 0.0, kBallMm};
  const double before_mm = clay.distance_at(top);
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayWorker worker(clay, worker_options(), ring, channel);
  ClayScene scene(scene_options(), ring, channel);
  for (int tick = 0; tick < 200; ++tick) {
    if (tick == 100) scene.forget_motion();
    HandleState handle;
    handle.time_s = 1e-3 * tick + (tick < 100 ? 0.0 : 0.03);
    handle.position_mm = {tick < 100 ? -8.0 : 8.0, 0.0, -1.0};
    handle.is_active = true;
    scene.begin_tick(handle);
    scene.end_tick(handle);
    if (tick % 10 == 0) {
      EXPECT_TRUE(worker.step().ok());
    }
  }
  EXPECT_TRUE(worker.finish().ok());
  EXPECT_EQ(worker.counts().strokes, 2U);
  EXPECT_EQ(clay.distance_at(top), before_mm);
  EXPECT_GT(clay.distance_at({-8.0, 0.0, kBallMm - 3.0}), 0.0);
  EXPECT_GT(clay.distance_at({8.0, 0.0, kBallMm - 3.0}), 0.0);
}

/// Two seconds of real time or more, the clay in its thread; then that ends under the servo.
TEST(ClayInLoop, RunsBesideTheServoInRealTime) {
  Clay clay = clay_ball_in_loop();
  const std::uint64_t before = clay.hash();
  ToolSampleRing ring(256);
  WindowChannel channel;
  ClayWorker worker(clay, worker_options(), ring, channel);
  ClayHeartbeat heartbeat;
  ClaySceneOptions options = scene_options();
  options.heartbeat = &heartbeat;
  ClayScene scene(options, ring, channel);
  auto started = ClayThread::start(worker, heartbeat);
  ASSERT_TRUE(started.ok());
  const auto begin = std::chrono::steady_clock::now();
  bool finite = true;
  std::uint32_t faults = 0;
  HandleState handle;
  for (int tick = 0; tick < 2000 || scene.window().sequence <= 20; ++tick) {
    const double t = 1e-3 * tick;
    handle = hand_at(std::fmod(t, 0.8));
    handle.time_s = t;
    scene.begin_tick(handle);
    scene.end_tick(handle);
    const SceneForce force = scene.force_at(handle);
    finite = finite && is_finite(force.force_n);
    faults |= force.faults;
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(tick + 1));
  }
  EXPECT_TRUE(finite);
  EXPECT_EQ(faults & haptics::kSceneClayStopped, 0U);
  EXPECT_GT(scene.window().answers, 0U);
  EXPECT_TRUE(started.value()->stop().ok());
  scene.begin_tick(handle);
  scene.end_tick(handle);
  EXPECT_NE(scene.force_at(handle).faults & haptics::kSceneClayStopped, 0U);
  EXPECT_NE(clay.hash(), before);
  EXPECT_FALSE(clay.is_stroke_open());
  EXPECT_TRUE(clay.validate().empty());
  EXPECT_GE(worker.counts().strokes, 2U);
  EXPECT_GT(worker.counts().windows, 20U);
}

/// A scene beside the clay's thread touches neither heap nor lock nor the system.
TEST(ClayInLoopRealtime, TicksWithoutHeapLockOrSystemCall) {
  Clay clay = clay_ball_in_loop();
  ToolSampleRing ring(256);
  WindowChannel channel;
  ClayWorker worker(clay, worker_options(), ring, channel);
  ClayHeartbeat heartbeat;
  auto started = ClayThread::start(worker, heartbeat);
  ASSERT_TRUE(started.ok());
  test::RealtimeCounts counts;
  bool is_counting = false;
  std::uint64_t windows = 0;
  std::thread([&] {
    ClaySceneOptions options = scene_options();
    options.heartbeat = &heartbeat;
    options.texture.emplace();
    ClayScene scene(options, ring, channel);
    is_counting = test::start_counting_this_thread();
    if (!is_counting) return;
    for (int tick = 0; tick < 40'000 || scene.window().sequence < 3; ++tick) {
      HandleState handle = hand_at(std::fmod(1e-3 * tick, 0.8));
      handle.time_s = 1e-3 * tick;
      scene.begin_tick(handle);
      scene.end_tick(handle);
      for (int query = 0; query < scene.most_queries(); ++query) scene.force_at(handle);
    }
    windows = scene.window().sequence;
    counts = test::counts_of_this_thread();
  }).join();
  EXPECT_TRUE(started.value()->stop().ok());
  if (!is_counting) GTEST_SKIP() << "this kernel has no seccomp filters";
  EXPECT_EQ(counts.heap, 0);
  EXPECT_EQ(counts.locks, 0);
  EXPECT_EQ(counts.system_calls, 0);
  EXPECT_GE(windows, 3U);
}

}  // namespace
}  // namespace argil
