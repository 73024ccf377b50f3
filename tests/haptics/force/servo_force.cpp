// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/servo_force.h"

#include <atomic>
#include <cmath>
#include <span>
#include <thread>

#include <gtest/gtest.h>

#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"

namespace argil::haptics {
namespace {

/// From one window to the next, at 1 kHz.
constexpr int kBlendTicks = 5;
static_assert(ServoForce::kBlendMs == 5.0);

using namespace fields;

TEST(ServoForce, FeelsNothingBeforeTheFirstWindow) {
  WindowChannel channel;
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceResult result = servo.tick(ball_tool(4.0, {}));
  EXPECT_TRUE(result.outside_window);
  EXPECT_EQ(result.contact_n, Vec3{});
  EXPECT_EQ(servo.window().sequence, 0U);
}

TEST(ServoForce, IsTheLatticeForceOnASteadyWindow) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  publisher.publish(plane({0, 0, 1}), tool);
  const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
  for (int i = 0; i < 3; ++i) {
    const ForceResult result = servo.tick(tool);
    EXPECT_EQ(result.contact_n, lattice.evaluate(servo.window().view(), tool).contact_n);
  }
  EXPECT_EQ(servo.window().sequence, 1U);
}

/// A lower window that differs by half the force: it is gone over to evenly in the stated ticks.
TEST(ServoForce, GoesOverToANewWindowEvenly) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  publisher.publish(plane({0, 0, 1}), tool);
  servo.tick(tool);
  const Vec3 old = servo.tick(tool).contact_n;
  publisher.publish(plane({0, 0, 1}, -3.0), tool);
  Vec3 last = old;
  double largest_step = 0.0;
  for (int i = 0; i < kBlendTicks; ++i) {
    const Vec3 now = servo.tick(tool).contact_n;
    largest_step = std::max(largest_step, length(now - last));
    last = now;
  }
  const ForceTool lower = ball_tool(4.0, {0, 0, 1});
  const LatticeForce lattice(lower, {}, ForceLaw::energy, choose_lattice(lower).voxel_mm);
  const Vec3 target = lattice.evaluate(servo.window().view(), tool).contact_n;
  EXPECT_EQ(last, target);
  EXPECT_GT(length(old - target), 1.0);
  EXPECT_NEAR(largest_step, length(old - target) / kBlendTicks, 1e-9);
}

/// Many windows in a row, lower ones and higher ones: no step larger than its share.
TEST(ServoForce, StaysContinuousWhenWindowsFollowEachOther) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  publisher.publish(plane({0, 0, 1}), tool);
  Vec3 last = servo.tick(tool).contact_n;
  for (int i = 0; i < 200; ++i) {
    if (i % 7 == 0) publisher.publish(plane({0, 0, 1}, i % 14 == 0 ? -2.0 : 0.0), tool);
    const Vec3 now = servo.tick(tool).contact_n;
    EXPECT_LE(length(now - last), 1.4 / kBlendTicks + 0.01) << i;  // of steps of 1.4 N
    last = now;
  }
}

/// A tool of another size takes effect with the window that fits it, and without a step.
TEST(ServoForce, ChangesTheToolWithTheWindowThatFitsIt) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceTool small = ball_tool(2.0, {0, 0, 2});
  const ForceTool large = ball_tool(6.0, {0, 0, 2});
  publisher.publish(plane({0, 0, 1}), small);
  servo.tick(small);
  const Vec3 old = servo.tick(small).contact_n;
  EXPECT_EQ(servo.tick(large).contact_n, old);  // no window for it yet
  publisher.publish(plane({0, 0, 1}), large);
  EXPECT_LE(length(servo.tick(large).contact_n - old), 0.1);
  ForceResult result;
  // The larger tool has more energy there, which is paid by and by.
  for (int i = 0; i < 10'000; ++i) result = servo.tick(large);
  const LatticeForce lattice(large, {}, ForceLaw::energy, choose_lattice(large).voxel_mm);
  EXPECT_EQ(result.contact_n, lattice.evaluate(servo.window().view(), large).contact_n);
  EXPECT_GT(length(result.contact_n - old), 0.05);
}

/// A window that is meant for neither the old tool nor the new one has no bound on what a sum over
/// it would cost, so it is not summed; the next one that fits is.
TEST(ServoForce, DoesNotSumAWindowMeantForAnotherTool) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  const ForceTool large = ball_tool(16.0, {0, 0, 8});
  publisher.publish(plane({0, 0, 1}), large);
  EXPECT_FALSE(servo.tick(large).outside_window);
  publisher.publish(plane({0, 0, 1}), ball_tool(1.0, {0, 0, 8}));
  ForceResult result;
  for (int i = 0; i <= kBlendTicks; ++i) {
    result = servo.tick(large);
    EXPECT_TRUE(result.outside_window);
  }
  EXPECT_EQ(result.samples, 0);
  publisher.publish(plane({0, 0, 1}), large);
  EXPECT_FALSE(servo.tick(large).outside_window);
}

/// The tool is somewhere else by no motion of its own: what is felt there comes at once when that
/// is said, and else as far as it is paid for.
TEST(ServoForce, RecoversFromATeleport) {
  for (const bool is_told : {true, false}) {
    WindowChannel channel;
    AnalyticPublisher publisher(channel);
    ServoForce servo(channel, {}, ForceLaw::energy);
    const ForceTool far_above = ball_tool(2.0, {0, 0, 20});
    publisher.publish(plane({0, 0, 1}), far_above);
    servo.tick(far_above);
    const ForceTool far = ball_tool(2.0, {200, 0, 0});
    EXPECT_TRUE(servo.tick(far).outside_window);
    if (is_told) servo.forget_motion();
    publisher.publish(plane({0, 0, 1}), far);
    ForceResult result = servo.tick(far);
    EXPECT_FALSE(result.outside_window);
    EXPECT_NEAR(result.contact_n.z, is_told ? 3.04 : 0.0, 0.02);
    if (is_told) continue;
    for (int i = 0; i < 10'000; ++i) result = servo.tick(far);
    EXPECT_NEAR(result.contact_n.z, 3.04, 0.02);
  }
}

/// A fast hand leaves its window along the surface: the next one gives back what it felt before,
/// and no more.
TEST(ServoForce, GivesBackWhatWasFeltWhereTheToolLeftItsWindow) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  publisher.publish(plane({0, 0, 1}), ball_tool(2.0, {0, 0, 0}));
  const Vec3 before = servo.tick(ball_tool(2.0, {0, 0, 0})).contact_n;
  const ForceTool beside = ball_tool(2.0, {30, 0, 0});
  EXPECT_TRUE(servo.tick(beside).outside_window);
  publisher.publish(plane({0, 0, 1}), beside);
  ForceResult result;
  for (int i = 0; i < kBlendTicks; ++i) result = servo.tick(beside);
  EXPECT_FALSE(result.outside_window);
  EXPECT_LE(length(result.contact_n - before), 0.01);
}

/// A coupling asks at several points: each is the two windows' forces there by the same shares.
TEST(ServoForce, AnswersAnyPoseWithinATick) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce asked(channel, {}, ForceLaw::energy);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  const ForceTool near = ball_tool(4.0, {0.5, 0, 0.2});
  publisher.publish(plane({0, 0, 1}), tool);
  asked.begin_tick(tool);
  const Vec3 old = asked.at(near).contact_n;
  publisher.publish(plane({0, 0, 1}, -3.0), tool);
  const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
  for (int i = 1; i <= kBlendTicks; ++i) {
    asked.begin_tick(tool);
    const Vec3 target = lattice.evaluate(asked.window().view(), near).contact_n;
    const double share = static_cast<double>(i) / kBlendTicks;
    EXPECT_LE(length(asked.at(near).contact_n - ((1.0 - share) * old + share * target)), 1e-12);
    EXPECT_EQ(asked.at(near).contact_n, asked.at(near).contact_n);
  }
  EXPECT_GT(length(old - asked.at(near).contact_n), 1.0);
}

TEST(ServoForce, TakesThePointForceWhenAsked) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy, ForceMethod::point);
  ForceTool tool = ball_tool(4.0, {0, 0, 1});
  tool.velocity_mm_per_s = {0, 0, -10};
  publisher.publish(plane({0, 0, 1}), tool);
  const ForceResult felt = servo.tick(tool);
  const ForceResult point = point_force(servo.window().view(), tool, {});
  EXPECT_EQ(felt.contact_n, point.contact_n);
  EXPECT_EQ(felt.viscosity_n, point.viscosity_n);
  EXPECT_GT(felt.contact_n.z, 1.0);
}

/// Under the thread sanitizer: one thread publishes, one ticks; every window is whole and none is
/// older than the last.
TEST(ServoForceStress, ReadsWholeWindowsInOrder) {
  WindowChannel channel;
  std::atomic<bool> done = false;
  std::thread clay([&] {
    AnalyticPublisher publisher(channel);
    for (int i = 0; i < 60; ++i) {
      publisher.publish(plane({0, 0, 1}, 0.02 * i), ball_tool(2.0, {0, 0, 0}), 1.0);
    }
    done = true;
  });
  ServoForce servo(channel, {}, ForceLaw::energy);
  std::uint64_t last = 0;
  int windows = 0;
  while (!done || windows == 0) {
    const ForceResult result = servo.tick(ball_tool(2.0, {0, 0, 0}));
    EXPECT_TRUE(is_finite(result.contact_n));
    const WindowSlot& slot = servo.window();
    if (slot.sequence == last) continue;
    EXPECT_GT(slot.sequence, last);
    EXPECT_EQ(window_checksum(slot.view()), slot.checksum);
    last = slot.sequence;
    ++windows;
  }
  clay.join();
  EXPECT_GT(windows, 0);
}

}  // namespace
}  // namespace argil::haptics
