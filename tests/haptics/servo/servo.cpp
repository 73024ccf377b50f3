// SPDX-License-Identifier: GPL-3.0-or-later
// The loop itself: what it does when something fails, and that it comes back gently.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/servo/servo_run.h"

#include "haptics/servo/loop_scenes.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

using scenes::PlainWall;

/// A hand that presses a soft wall, ticked by hand, so that anything can be broken in between.
struct ServoBench {  // NOLINT(clang-analyzer-optin.performance.Padding): the ring's cache lines
  PlainWall wall{500.0};
  SimFalcon device;
  ServoOptions options;
  ServoTickRing ring{16};
  Servo servo;
  double now_s = 0.0;

  ServoBench()
      : device({}, hand_model(Hand::arm),
               HandPlan(press_plan({0.0, -6.0, 0.0}, scenes::kDown, 2.0))),
        servo(device, wall, options, &ring) {}

  ServoTick tick() {
    now_s += kTickS;
    return servo.tick(now_s);
  }
  std::vector<ServoTick> run(int ticks) {
    std::vector<ServoTick> seen;
    seen.reserve(static_cast<std::size_t>(ticks));
    for (int n = 0; n < ticks; ++n) seen.push_back(tick());
    return seen;
  }
};

/// After a fault: no tick's force exceeds what the ramp of half a second allows.
void expect_ramp_in(const std::vector<ServoTick>& ticks) {
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    const double gain = std::min(1.0, 2.0 * kTickS * static_cast<double>(n + 1));
    ASSERT_LE(length(ticks[n].force_n), gain * length(ticks[n].wanted_n) + 2e-2) << n;
  }
}

TEST(ServoFaults, NoneInAQuietPress) {
  ServoBench bench;
  const std::vector<ServoTick> ticks = bench.run(3000);
  EXPECT_EQ(bench.servo.faults_seen(), kServoSound);
  EXPECT_NEAR(ticks.back().force_n.y, 2.0, 0.2);
  EXPECT_EQ(ticks.back().wanted_n, ticks.back().force_n);
}

TEST(ServoFaults, RampsInAtTheStart) {
  ServoBench bench;
  expect_ramp_in(bench.run(600));
}

TEST(ServoFaults, NaNFromTheSceneCutsToZero) {
  ServoBench bench;
  bench.run(2000);
  bench.wall.bad = true;
  const ServoTick tick = bench.tick();
  EXPECT_EQ(tick.force_n, Vec3{});
  EXPECT_NE(tick.faults & kForceNotFinite, 0U);
  bench.wall.bad = false;
  expect_ramp_in(bench.run(800));
  EXPECT_NEAR(bench.run(2000).back().force_n.y, 2.0, 0.2);
}

TEST(ServoFaults, ALostDeviceGetsNothingAndComesBackGently) {
  ServoBench bench;
  bench.run(2000);
  bench.device.set_plugged(false);
  for (const ServoTick& tick : bench.run(50)) {
    EXPECT_EQ(tick.force_n, Vec3{});
    EXPECT_NE(tick.faults & kDeviceLost, 0U);
  }
  EXPECT_EQ(bench.wall.forgotten, 50);
  bench.device.set_plugged(true);
  const std::vector<ServoTick> back = bench.run(800);
  EXPECT_EQ(back.front().faults & kDeviceLost, 0U);
  expect_ramp_in(back);
}

TEST(ServoFaults, AJumpOfTheClockCutsToZero) {
  for (const double jump_s : {1.0, -1.0}) {
    ServoBench bench;
    bench.run(2000);
    bench.now_s += jump_s;
    const ServoTick tick = bench.tick();
    EXPECT_EQ(tick.force_n, Vec3{}) << jump_s;
    EXPECT_NE(tick.faults & kClockJumped, 0U);
    EXPECT_EQ(tick.velocity_mm_per_s, Vec3{});
    EXPECT_EQ(bench.wall.forgotten, 1) << jump_s;
    if (jump_s > 0.0) expect_ramp_in(bench.run(800));
  }
}

TEST(ServoFaults, AStaleWindowRampsOutWithinTwentyMilliseconds) {
  for (const std::uint32_t fault : {kSceneWindowStale, kSceneOutsideWindow, kSceneClayStopped}) {
    ServoBench bench;
    bench.run(2000);
    bench.wall.faults = fault;
    const std::vector<ServoTick> ticks = bench.run(50);
    for (std::size_t n = 1; n < ticks.size(); ++n) {
      EXPECT_LE(length(ticks[n].force_n), length(ticks[n - 1].force_n));
      EXPECT_LE(length(ticks[n].force_n - ticks[n - 1].force_n), 2.0 + 1e-9);
    }
    EXPECT_EQ(ticks[20].force_n, Vec3{});
    bench.wall.faults = kSceneSound;
    expect_ramp_in(bench.run(800));
  }
}

TEST(ServoFaults, AFullRingIsCountedAndFeltByNobody) {
  ServoBench recorded;
  ServoBench free;
  ServoTick with;
  for (int n = 0; n < 500; ++n) {
    with = recorded.tick();
    const ServoTick without = free.tick();
    for (ServoTick taken; free.ring.pop(taken);) {
    }
    ASSERT_EQ(with.force_n, without.force_n);
  }
  EXPECT_EQ(recorded.ring.dropped(), 500U - 16U);
  EXPECT_EQ(with.faults, kServoSound);
}

TEST(ServoFaults, AHaltGivesZeroFromTheNextTickUntilItIsResumed) {
  ServoBench bench;
  bench.run(2000);
  ASSERT_GT(length(bench.device.held_force_n()), 1.0);
  bench.servo.halt();
  const std::vector<ServoTick> halted = bench.run(50);
  for (std::size_t n = 0; n < halted.size(); ++n) {
    EXPECT_EQ(halted[n].force_n, Vec3{}) << n;
    EXPECT_NE(halted[n].faults & kHalted, 0U);
  }
  EXPECT_EQ(bench.device.held_force_n(), Vec3{});
  EXPECT_EQ(bench.wall.forgotten, 50);
  bench.servo.resume();
  const std::vector<ServoTick> back = bench.run(800);
  EXPECT_EQ(back.front().faults, kServoSound);
  expect_ramp_in(back);
  EXPECT_NEAR(bench.run(2000).back().force_n.y, 2.0, 0.2);
}

/// The motors themselves: a tick for the command and one for their delay.
TEST(ServoFaults, AHaltReachesTheMotorsWithinTwoTicks) {
  ServoBench bench;
  bench.run(2000);
  bench.servo.halt();
  bench.run(2);
  EXPECT_EQ(bench.device.held_force_n(), Vec3{});
}

TEST(ServoFaults, StoppingGivesZero) {
  SimFalcon device({}, hand_model(Hand::arm),
                   HandPlan(press_plan({0.0, -6.0, 0.0}, scenes::kDown, 2.0)));
  PlainWall wall(500.0);
  {
    Servo servo(device, wall, {});
    for (int n = 1; n < 2000; ++n) servo.tick(1e-3 * n);
    EXPECT_GT(length(device.held_force_n()), 1.0);
  }
  device.write({});  // the delay of a tick
  EXPECT_EQ(device.held_force_n(), Vec3{});
}

TEST(ServoFaults, AReadingThatIsNoNumberIsALostDevice) {
  class Broken final : public Device {
   public:
    DeviceReading read(double) noexcept override {
      return {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, 0, true};
    }
    void write(const Vec3& force_n) noexcept override { force = force_n; }
    DeviceTraits traits(double period_s) const noexcept override {
      return {0.4589, 3.0, 9.0, period_s, 0.06};
    }
    Vec3 force{1.0, 0.0, 0.0};
  };
  Broken device;
  PlainWall wall(500.0);
  Servo servo(device, wall, {});
  EXPECT_NE(servo.tick(1e-3).faults & kDeviceLost, 0U);
  EXPECT_EQ(device.force, Vec3{});
}

TEST(ServoRun, TicksOnVirtualTimeWithoutBeingLate) {
  ServoBench bench;
  VirtualClock clock;
  const std::atomic<bool> stop = false;
  const ServoRun run = run_servo(bench.servo, clock, 2.0, stop);
  EXPECT_EQ(run.ticks, 2000U);
  EXPECT_EQ(run.late_ticks, 0U);
  EXPECT_NEAR(run.period.quantile_us(0.5), 1000.0, 21.0);
  EXPECT_EQ(run.faults, kServoSound);
}

/// A clock that stands still for a while, as a machine under load does.
class StallingClock final : public ServoClock {
 public:
  double now_s() noexcept override { return clock_.now_s(); }
  void wait_until(double time_s) noexcept override {
    clock_.wait_until(time_s);
    if (++waits_ == 1000) clock_.jump(0.030);
    if (waits_ == 1500) clock_.jump(1.0);
  }

 private:
  VirtualClock clock_;
  int waits_ = 0;
};

TEST(ServoRun, SkipsWhatItMissedAndSaysSo) {
  ServoBench bench;
  StallingClock clock;
  const std::atomic<bool> stop = false;
  const ServoRun run = run_servo(bench.servo, clock, 4.0, stop);
  EXPECT_GE(run.late_ticks, 2U);
  EXPECT_NEAR(static_cast<double>(run.skipped_ticks), 1030.0, 4.0);
  EXPECT_NEAR(static_cast<double>(run.ticks + run.skipped_ticks), 4000.0, 1.0);
  EXPECT_EQ(run.faults, kClockJumped);  // 30 ms are late, 1 s is a jump
  EXPECT_GT(run.lateness.max_us(), 0.9e6);
}

TEST(ServoRun, EndsWhenItIsToldTo) {
  ServoBench bench;
  VirtualClock clock;
  const std::atomic<bool> stop = true;
  EXPECT_EQ(run_servo(bench.servo, clock, 10.0, stop).ticks, 0U);
}

TEST(ServoThreadRealtime, RunsOnTheMachinesClock) {
  ServoBench bench;
  ServoThread thread(bench.servo);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const ServoRun& run = thread.stop();
  EXPECT_GT(run.ticks, 30U);  // a loaded machine skips, but does not stand still
  EXPECT_EQ(thread.stop().ticks, run.ticks);
  std::printf("servo thread: %llu ticks, %llu skipped, period p50 %.0f p99 %.0f max %.0f us%s%s\n",
              static_cast<unsigned long long>(run.ticks),
              static_cast<unsigned long long>(run.skipped_ticks), run.period.quantile_us(0.5),
              run.period.quantile_us(0.99), run.period.max_us(),
              thread.priority_refusal().empty() ? "" : "; ", thread.priority_refusal().c_str());
}

TEST(Histogram, GivesQuantilesWithinTwoPercent) {
  Histogram histogram;
  for (int n = 1; n <= 10'000; ++n) histogram.add(0.1 * n);
  EXPECT_NEAR(histogram.quantile_us(0.5), 500.0, 10.5);
  EXPECT_NEAR(histogram.quantile_us(0.99), 990.0, 20.5);
  EXPECT_DOUBLE_EQ(histogram.max_us(), 1000.0);
  EXPECT_DOUBLE_EQ(histogram.quantile_us(1.0), 1000.0);
  EXPECT_EQ(Histogram().quantile_us(0.5), 0.0);
}

}  // namespace
}  // namespace argil::haptics
