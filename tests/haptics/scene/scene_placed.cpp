// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_placed.h"

#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_wall.h"
#include "argil/haptics/servo/servo.h"

#include "haptics/scene/scene_checks.h"
#include "haptics/servo/loop_scenes.h"
#include "haptics/servo/tick.h"

namespace argil::haptics {
namespace {

using scenes::PlainWall;

/// A device that is where the test puts it.
class HeldDevice final : public Device {
 public:
  DeviceReading read(double) noexcept override { return {place_mm, buttons, true}; }
  void write(const Vec3& force) noexcept override { force_n = force; }
  DeviceTraits traits(double period_s) const noexcept override {
    return {0.4589, 3.0, 9.0, period_s, 0.06};
  }
  Vec3 place_mm;
  std::uint32_t buttons = 0;
  Vec3 force_n;
};

struct PlacedBench {
  explicit PlacedBench(const Placement& placement = {}, const ServoOptions& options = {})
      : placed(wall, placement), servo(device, placed, options) {}

  ServoTick tick() {
    ++ticks;
    return servo.tick(kTickS * ticks);
  }
  ServoTick run(int count) {
    ServoTick last;
    for (int n = 0; n < count; ++n) last = tick();
    return last;
  }

  PlainWall wall{500.0};
  HeldDevice device;
  PlacedScene placed;
  Servo servo;
  int ticks = 0;
};

TEST(PlacedScene, ChangesNothingAtScaleOne) {
  SpringScene spring;
  PlacedScene placed(spring, {});
  const HandleState place = scenes::at({3.0, -2.0, 1.0}, {10.0, 0.0, -5.0});
  EXPECT_EQ(placed.force_at(place).force_n, spring.force_at(place).force_n);
  EXPECT_EQ(placed.force_at(place).stiffness_n_per_m, spring.force_at(place).stiffness_n_per_m);
}

TEST(PlacedScene, FeelsTheForceOfThePlaceInTheScene) {
  SpringScene spring;
  const Placement placement{4.0, {10.0, 20.0, -30.0}};
  PlacedScene placed(spring, placement);
  const Vec3 device{3.0, -2.0, 1.0};
  const Vec3 inside{22.0, 12.0, -26.0};
  EXPECT_EQ(placement.to_scene(device), inside);
  EXPECT_LE(length(placement.to_device(inside) - device), 1e-12);
  EXPECT_EQ(scenes::force(placed, device, {5.0, 0.0, 0.0}),
            scenes::force(spring, inside, {20.0, 0.0, 0.0}));
}

/// Up is up and right is right: what lies before the scene is nearer to the hand.
TEST(PlacedScene, TurnsASceneWhoseZIsUp) {
  SpringScene spring;
  const Placement placement{2.0, {10.0, 20.0, -30.0}, true};
  PlacedScene placed(spring, placement);
  EXPECT_EQ(placement.turned({0.0, 1.0, 0.0}), (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(placement.turned({0.0, 0.0, 1.0}), (Vec3{0.0, -1.0, 0.0}));
  EXPECT_EQ(placement.turned({1.0, 0.0, 0.0}), (Vec3{1.0, 0.0, 0.0}));
  const Vec3 device{3.0, -2.0, 1.0};
  const Vec3 inside{16.0, 18.0, -34.0};
  EXPECT_EQ(placement.to_scene(device), inside);
  EXPECT_EQ(placement.to_device(inside), device);
  const Vec3 felt = scenes::force(placed, device, {5.0, 7.0, 0.0});
  EXPECT_EQ(placement.turned(felt), scenes::force(spring, inside, {10.0, 0.0, 14.0}));
}

/// s k in the hand, by finite differences and as reported.
TEST(PlacedScene, MultipliesTheStiffnessByTheScale) {
  for (const double scale : {0.25, 1.0, 3.0}) {
    PlainWall wall(500.0);
    PlacedScene placed(wall, {scale, {}});
    EXPECT_DOUBLE_EQ(placed.force_at(scenes::at({0.0, -1.0, 0.0})).stiffness_n_per_m,
                     500.0 * scale);
    scenes::expect_stiffness_is_the_slope(placed, {0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}, 1e-6);
  }
}

/// The governor bounds what the hand feels, whatever the scale makes of the scene.
TEST(PlacedScene, IsSteadyUnderTheGovernorAtAnyScale) {
  for (const double scale : {0.1, 1.0, 20.0}) {
    for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
      PlainWall wall(1000.0);
      PlacedScene placed(wall, {scale, {}});
      const double coupled = 1000.0 * scale * 1000.0 / (1000.0 * scale + 1000.0);
      const HoldTestResult held = run_hold_test(placed, scenes::press_wall(hand, coupled, {}));
      EXPECT_EQ(held.judgement.verdict, Verdict::quiet) << scale << " " << hand_model(hand).name;
    }
  }
}

/// Without it the same wall, scaled, is beyond the limit: why check_rig looks at s k.
TEST(PlacedScene, CyclesWithoutTheCouplingWhereTheScaledStiffnessIsBeyondTheLimit) {
  ServoOptions direct;
  direct.coupling.kind = CouplingKind::direct;
  for (const double scale : {1.0, 10.0}) {
    PlainWall wall(1000.0);
    PlacedScene placed(wall, {scale, {}});
    const HoldTestResult held =
        run_hold_test(placed, scenes::press_wall(Hand::push, 1000.0 * scale, direct));
    EXPECT_EQ(held.judgement.verdict == Verdict::quiet, scale == 1.0) << scale;
  }
}

TEST(PlacedSceneClutch, FadesTheForceOutAndMovesNoTool) {
  PlacedBench bench;
  bench.device.place_mm.y = -4.0;
  const ServoTick before = bench.run(1000);
  ASSERT_GT(before.force_n.y, 1.0);
  const Vec3 tool = bench.placed.tool_mm();
  bench.placed.set_clutched(true);
  Vec3 last = before.force_n;
  for (int n = 0; n < 200; ++n) {
    bench.device.place_mm.y += 0.1;
    const ServoTick tick = bench.tick();
    EXPECT_NE(tick.faults & kClutched, 0U);
    EXPECT_LE(length(tick.force_n - last), 0.06 * length(before.force_n));
    last = tick.force_n;
    if (n >= 25) {
      EXPECT_EQ(tick.force_n, Vec3{}) << n;
    }
    EXPECT_EQ(bench.placed.tool_mm(), tool);
  }
}

TEST(PlacedSceneClutch, ComesBackWhereTheToolWasWithoutAJump) {
  for (const int held_ms : {1, 20, 500}) {
    PlacedBench bench({2.0, {0.0, 1.0, 0.0}});
    bench.device.place_mm.y = -3.0;
    ServoTick last = bench.run(1000);
    const Vec3 tool = bench.placed.tool_mm();
    bench.placed.set_clutched(true);
    double most_step = 0.0;
    for (int n = 0; n < 1500; ++n) {
      if (n == held_ms) bench.placed.set_clutched(false);
      if (n < held_ms) bench.device.place_mm.x += 0.05;
      const ServoTick tick = bench.tick();
      most_step = std::max(most_step, length(tick.force_n - last.force_n));
      last = tick;
    }
    EXPECT_LE(most_step, 0.06 * 8.0) << held_ms;
    EXPECT_EQ(last.faults & kClutched, 0U);
    EXPECT_LE(length(bench.placed.placement().to_scene(bench.device.place_mm) - tool), 1e-9)
        << held_ms;
    EXPECT_DOUBLE_EQ(bench.placed.placement().scale, 2.0);
    EXPECT_GT(last.force_n.y, 0.3);
  }
}

/// Also where the tool is worked with: the stroke ends, and what follows is another.
TEST(PlacedSceneClutch, DoesNotWorkTheScene) {
  class Listener final : public ForceScene {
   public:
    SceneForce force_at(const HandleState&) const noexcept override { return {}; }
    void end_tick(const HandleState& tool) noexcept override { last = tool; }
    HandleState last;
  };
  Listener listener;
  PlacedScene placed(listener, {});
  HandleState handle = scenes::at({1.0, 0.0, 0.0}, {100.0, 0.0, 0.0});
  handle.is_active = true;
  const auto tick = [&] {
    handle.time_s += kTickS;
    placed.begin_tick(handle);
    placed.end_tick(handle);
  };
  tick();
  EXPECT_TRUE(listener.last.is_active);
  placed.set_clutched(true);
  handle.position_mm.x = 5.0;
  tick();
  EXPECT_FALSE(listener.last.is_active);
  EXPECT_EQ(listener.last.position_mm.x, 1.0);
  EXPECT_EQ(listener.last.velocity_mm_per_s, Vec3{});
  placed.forget_motion();
  tick();
  EXPECT_EQ(listener.last.position_mm.x, 1.0);
  placed.set_clutched(false);
  for (int n = 0; n < 60; ++n) tick();
  EXPECT_TRUE(listener.last.is_active);
  EXPECT_EQ(listener.last.position_mm.x, 1.0);
  EXPECT_EQ(placed.placement().offset_mm.x, -4.0);
}

}  // namespace
}  // namespace argil::haptics
