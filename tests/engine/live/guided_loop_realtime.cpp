// SPDX-License-Identifier: GPL-3.0-or-later
// What the servo's thread does in a HapticRig: a guided hand, clay that is placed, the clutch and
// the emergency stop, the watch that tells the window, and a recording that begins and ends.
#include <atomic>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "argil/engine/clay_thread.h"
#include "argil/engine/clay_worker.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/scene/scene_placed.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/guided_hand.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "rig/rig_watch.h"
#include "support/realtime_counters.h"

namespace argil {
namespace {

TEST(HapticRigRealtime, TicksWithoutHeapLockOrSystemCall) {
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
  std::uint32_t faults = haptics::kServoSound;
  std::uint64_t windows = 0;
  std::thread([&] {
    haptics::ClaySceneOptions felt;
    felt.tool.radii_mm = {3.0, 3.0, 3.0};
    felt.heartbeat = &heartbeat;
    haptics::ClayScene scene(felt, samples, channel);
    haptics::PlacedScene placed(scene, {2.0, {0.0, 15.0, 0.0}});
    haptics::GuidedHand hand;
    haptics::SimFalcon device({}, haptics::hand_model(haptics::Hand::arm), hand);
    haptics::ServoTickRing recording(64);
    haptics::Servo servo(device, placed, {});
    haptics::RigWatch watch(placed, samples);
    haptics::VirtualClock clock;
    const std::atomic<bool> goes_on = false;
    is_counting = test::start_counting_this_thread();
    if (!is_counting) return;
    for (int n = 0; n < 40 || (windows < 3 && n < 100'000); ++n) {
      // The main thread's part, here between the ticks.
      hand.set({{0.1 * (n % 20), n % 2 == 0 ? -1.0 : 1.0, 0.0}, true, n % 4 == 3});
      placed.set_clutched(n % 10 == 5);
      n % 10 == 7 ? servo.halt() : servo.resume();
      if (n % 4 == 2) watch.record(&recording);
      watch.snapshots().fetch();
      faults |= haptics::run_servo(servo, clock, 0.5, goes_on, &watch).faults;
      windows = placed.window_stamp().sequence;
    }
    counts = test::counts_of_this_thread();
  }).join();
  EXPECT_TRUE(started.value()->stop().ok());
  if (!is_counting) GTEST_SKIP() << "this kernel has no seccomp filters";
  EXPECT_EQ(counts.heap, 0);
  EXPECT_EQ(counts.locks, 0);
  EXPECT_EQ(counts.system_calls, 0);
  EXPECT_NE(faults & haptics::kHalted, 0U);
  EXPECT_NE(faults & haptics::kClutched, 0U);
  EXPECT_GE(windows, 3U);
}

}  // namespace
}  // namespace argil
