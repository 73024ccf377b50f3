// SPDX-License-Identifier: GPL-3.0-or-later
// The whole servo loop, simulated Falcon and recording included, beside a clay that it carves.
#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay_thread.h"
#include "argil/engine/clay_worker.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/scene/scene_vibro.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "support/realtime_counters.h"

namespace argil {
namespace {

/// Presses the top of a ball of clay and works it now and then.
std::vector<haptics::HandKey> press_and_carve() {
  std::vector<haptics::HandKey> plan;
  for (int n = 0; n < 40; ++n) {
    haptics::HandKey key;
    key.time_s = 0.5 * n;
    key.place_mm = {n % 2 == 0 ? -2.0 : 2.0, 1.0, 0.0};
    key.press_n = 1.0;
    key.is_active = n % 4 == 3;
    plan.push_back(key);
  }
  return plan;
}

TEST(ServoLoopRealtime, TicksWithoutHeapLockOrSystemCall) {
  ClayOptions clay_options;
  clay_options.voxel_mm = 0.5;
  Clay clay = Clay::ball(15.0, clay_options).value();
  ToolSampleRing samples(256);
  WindowChannel channel;
  ClayWorkerOptions worker_options;
  worker_options.tool = {Action::carve, Shape::ball, {3.0, 3.0, 3.0}, 1.0};
  ClayWorker worker(clay, worker_options, samples, channel);
  ClayHeartbeat heartbeat;
  auto started = ClayThread::start(worker, heartbeat);
  ASSERT_TRUE(started.ok());

  test::RealtimeCounts counts;
  bool is_counting = false;
  std::uint64_t windows = 0;
  bool is_finite_all = true;
  std::thread([&] {
    haptics::ClaySceneOptions scene_options;
    scene_options.tool.radii_mm = {3.0, 3.0, 3.0};
    scene_options.offset_mm = {0.0, 15.0, 0.0};
    scene_options.heartbeat = &heartbeat;
    haptics::ClayScene scene(scene_options, samples, channel);
    haptics::VibroScene felt(scene);
    haptics::SimFalcon device({}, haptics::hand_model(haptics::Hand::arm),
                              haptics::HandPlan(press_and_carve()));
    haptics::ServoOptions options;
    options.passivity.controls = true;
    options.damping.kind = haptics::DampingKind::adaptive;
    options.position_filter.emplace();
    haptics::ServoTickRing recording(64);  // it fills, and drops are counted
    haptics::Servo servo(device, felt, options, &recording);
    is_counting = test::start_counting_this_thread();
    if (!is_counting) return;
    for (std::uint64_t n = 1; n < 20'000 || (windows < 3 && n < 100'000'000); ++n) {
      const haptics::ServoTick tick = servo.tick(1e-3 * static_cast<double>(n));
      is_finite_all = is_finite_all && is_finite(tick.force_n);
      windows = tick.window.sequence;
    }
    servo.stop();
    counts = test::counts_of_this_thread();
  }).join();
  EXPECT_TRUE(started.value()->stop().ok());
  if (!is_counting) GTEST_SKIP() << "this kernel has no seccomp filters";
  EXPECT_EQ(counts.heap, 0);
  EXPECT_EQ(counts.locks, 0);
  EXPECT_EQ(counts.system_calls, 0);
  EXPECT_TRUE(is_finite_all);
  EXPECT_GE(windows, 3U);
}

}  // namespace
}  // namespace argil
