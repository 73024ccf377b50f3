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

/// Of a fade, at 1 kHz.
constexpr int kBlendTicks = 32;
static_assert(ServoForce::kFadeMs == 32.0);

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

/// A window that differs by half the force: the step is spread evenly over the stated ticks, and is
/// gone after them.
TEST(ServoForce, FadesTheStepOfANewWindow) {
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
  EXPECT_LE(length(last - target), 1e-12);
  EXPECT_GT(length(old - target), 1.0);
  EXPECT_NEAR(largest_step, length(old - target) / kBlendTicks, 1e-9);
}

/// Many windows in a row, none of them finished fading: still no step larger than its share.
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
    EXPECT_LE(length(now - last), 0.06) << i;  // of steps of 1.4 N
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
  for (int i = 0; i < kBlendTicks; ++i) result = servo.tick(large);
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
  const ForceResult result = servo.tick(large);
  EXPECT_TRUE(result.outside_window);
  EXPECT_EQ(result.samples, 0);
  publisher.publish(plane({0, 0, 1}), large);
  EXPECT_FALSE(servo.tick(large).outside_window);
}

/// The tool has left the old window when the new one comes: what was felt last is faded from.
TEST(ServoForce, RecoversFromATeleport) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce servo(channel, {}, ForceLaw::energy);
  publisher.publish(plane({0, 0, 1}), ball_tool(2.0, {0, 0, 0}));
  servo.tick(ball_tool(2.0, {0, 0, 0}));
  const ForceTool far = ball_tool(2.0, {200, 0, 0});
  EXPECT_TRUE(servo.tick(far).outside_window);
  publisher.publish(plane({0, 0, 1}), far);
  ForceResult result;
  for (int i = 0; i <= kBlendTicks; ++i) result = servo.tick(far);
  EXPECT_FALSE(result.outside_window);
  EXPECT_NEAR(result.contact_n.z, 3.04, 0.02);
}

/// A coupling asks at several points: each is the window's force there and the same step on top.
TEST(ServoForce, AnswersAnyPoseWithinATick) {
  WindowChannel channel;
  AnalyticPublisher publisher(channel);
  ServoForce asked(channel, {}, ForceLaw::energy);
  const ForceTool tool = ball_tool(4.0, {0, 0, 1});
  const ForceTool near = ball_tool(4.0, {0.5, 0, 0.2});
  publisher.publish(plane({0, 0, 1}), tool);
  asked.begin_tick(tool);
  const Vec3 old = asked.at(tool).contact_n;
  publisher.publish(plane({0, 0, 1}, -3.0), tool);
  const LatticeForce lattice(tool, {}, ForceLaw::energy, choose_lattice(tool).voxel_mm);
  for (int i = kBlendTicks - 1; i >= 0; --i) {
    asked.begin_tick(tool);
    const FieldWindowView view = asked.window().view();
    const Vec3 step = old - lattice.evaluate(view, tool).contact_n;
    const Vec3 expected =
        lattice.evaluate(view, near).contact_n + (static_cast<double>(i) / kBlendTicks) * step;
    EXPECT_LE(length(asked.at(near).contact_n - expected), 1e-12);
    EXPECT_EQ(asked.at(near).contact_n, asked.at(near).contact_n);
  }
  EXPECT_GT(length(old - asked.at(tool).contact_n), 1.0);
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
