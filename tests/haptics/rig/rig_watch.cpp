// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig/rig_watch.h"

#include <gtest/gtest.h>

#include "argil/haptics/scene/scene_spring.h"

namespace argil::haptics {
namespace {

struct Watched {  // NOLINT(clang-analyzer-optin.performance.Padding): one of them
  SpringScene spring;
  PlacedScene placed{spring, {}};
  ToolSampleRing samples{4};
  RigWatch watch{placed, samples};
  ServoRun run;

  void tick(std::uint64_t number, double force_n, double period_s = 1e-3) {
    ServoTick tick;
    tick.number = number;
    tick.time_s = period_s * static_cast<double>(number);
    tick.force_n.y = force_n;
    watch.after_tick(tick);
    watch.after_tick_of(run);
  }
};

TEST(RigWatch, LosesNoPeakBetweenItsPoints) {
  Watched watched;
  for (std::uint64_t n = 1; n <= 101; ++n) watched.tick(n, n == 35 ? -7.0 : 1.0);
  int points = 0;
  int peaks = 0;
  for (RigPoint point; watched.watch.points().pop(point); ++points) {
    if (point.force_n.y == -7.0) ++peaks;
    if (points > 0) {
      EXPECT_NEAR(point.rate_hz, 1000.0, 1e-6);
    }
  }
  EXPECT_EQ(points, 11);
  EXPECT_EQ(peaks, 1);
}

TEST(RigWatch, TellsEachTickOfASlowServo) {
  Watched watched;
  for (std::uint64_t n = 1; n <= 20; ++n) {
    watched.tick(n, 1.0, 0.02);
    ASSERT_TRUE(watched.watch.snapshots().fetch());
    EXPECT_EQ(watched.watch.snapshots().read_slot().tick.number, n);
  }
}

TEST(RigWatch, DropsPointsThatNobodyTakesAndGoesOn) {
  Watched watched;
  for (std::uint64_t n = 1; n <= 30'000; ++n) watched.tick(n, 1.0);
  EXPECT_GT(watched.watch.points().dropped(), 0U);
  ASSERT_TRUE(watched.watch.snapshots().fetch());
  EXPECT_GT(watched.watch.snapshots().read_slot().tick.number, 29'900U);
}

TEST(RigWatch, NumbersEachRecordingFromOne) {
  Watched watched;
  ServoTickRing first(8);
  ServoTickRing second(8);
  watched.tick(1, 1.0);
  watched.watch.record(&first);
  watched.tick(2, 1.0);
  watched.tick(3, 1.0);
  watched.watch.record(&second);
  watched.tick(4, 1.0);
  ServoTick tick;
  ASSERT_TRUE(first.pop(tick));
  EXPECT_EQ(tick.number, 1U);
  ASSERT_TRUE(first.pop(tick));
  EXPECT_EQ(tick.number, 2U);
  EXPECT_FALSE(first.pop(tick));
  ASSERT_TRUE(second.pop(tick));
  EXPECT_EQ(tick.number, 1U);
}

}  // namespace
}  // namespace argil::haptics
