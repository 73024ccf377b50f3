// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_clay.h"

#include <gtest/gtest.h>

#include "argil/haptics/bridge/bridge_world.h"

namespace argil::haptics {
namespace {

/// A floor at z = 10 of the clay's frame, 1000 N/m, that remembers what it was told.
class Floor final : public ForceScene {
 public:
  void begin_tick(const HandleState& handle) noexcept override { begun = handle; }
  SceneForce force_at(const HandleState& place) const noexcept override {
    const double depth_mm = 10.0 - place.position_mm.z;
    if (depth_mm <= 0.0) return {};
    return {{0.0, 0.0, depth_mm}, 1000.0, kSceneSound};
  }
  void end_tick(const HandleState& tool) noexcept override { ended = tool; }
  WindowStamp window_stamp() const noexcept override { return {3, 4}; }

  HandleState begun;
  HandleState ended;
};

/// Handle, simulator and clay.
struct ClayBench {
  BridgeWorld world{{}};
  BridgeSession session{world, terms()};
  Floor floor;
  BridgeClayScene scene{session, floor, {2.0, {5.0, 0.0, 20.0}, true}};
  HandleState handle;

  static BridgeTerms terms() {
    BridgeTerms terms;
    terms.law = BridgeLaw::clay;
    return terms;
  }
  /// As a servo does.
  SceneForce tick() {
    handle.time_s += 1e-3;
    scene.begin_tick(handle);
    const SceneForce felt = scene.force_at(handle);
    scene.end_tick(handle);
    ServoTick tick;
    tick.time_s = handle.time_s;
    tick.position_mm = handle.position_mm;
    tick.felt_mm = handle.position_mm;
    session.send_state(tick);
    return felt;
  }
};

TEST(BridgeClayScene, TurnsUpToUpAndScales) {
  ClayBench bench;
  bench.handle.position_mm = {1.0, 2.0, 3.0};
  bench.handle.velocity_mm_per_s = {10.0, 20.0, 30.0};
  bench.handle.is_active = true;
  bench.tick();
  EXPECT_EQ(bench.floor.begun.position_mm, (Vec3{7.0, -6.0, 24.0}));
  EXPECT_EQ(bench.floor.begun.velocity_mm_per_s, (Vec3{20.0, -60.0, 40.0}));
  EXPECT_EQ(bench.floor.ended.position_mm, bench.floor.begun.position_mm);
  EXPECT_TRUE(bench.floor.ended.is_active);
  EXPECT_EQ(bench.scene.window_stamp().sequence, 3U);
}

TEST(BridgeClayScene, GivesTheClaysForceUpwards) {
  ClayBench bench;
  bench.handle.position_mm = {0.0, -6.0, 0.0};  // 2 mm deep at twice the size
  const SceneForce felt = bench.tick();
  EXPECT_EQ(felt.force_n, (Vec3{0.0, 2.0, 0.0}));
  EXPECT_EQ(felt.stiffness_n_per_m, 2000.0) << "of the hand, whose millimetre is two of the clay";
}

TEST(BridgeClayScene, DoesNotCareWhatTheSimulatorSaysOrWhetherItDoes) {
  ClayBench bench;
  bench.handle.position_mm = {0.0, -6.0, 0.0};
  for (int n = 0; n < 3000; ++n) {
    if (n == 1000) bench.world.set_dead(true);
    if (n == 2000) bench.world.set_dead(false);
    ASSERT_EQ(bench.tick().force_n, (Vec3{0.0, 2.0, 0.0})) << n;
    if (n > 1400 && n < 2000) {
      ASSERT_EQ(bench.session.watch().gain(), 0.0) << "it was given up";
    }
  }
  EXPECT_EQ(bench.session.counts().sessions, 2U);
}

TEST(BridgeClayScene, StopsWhenTheSimulatorSaysStop) {
  ClayBench bench;
  bench.handle.position_mm = {0.0, -6.0, 0.0};
  bench.handle.is_active = true;
  for (int n = 0; n < 100; ++n) bench.tick();
  EXPECT_TRUE(bench.floor.ended.is_active);
  bench.world.stop(true);
  SceneForce felt;
  for (int n = 0; n < 100; ++n) felt = bench.tick();
  EXPECT_EQ(felt.force_n, Vec3{});
  EXPECT_NE(felt.faults & kSceneStopped, 0U);
  EXPECT_FALSE(bench.floor.ended.is_active) << "nor does the tool work";
  bench.world.say_bye();
  for (int n = 0; n < 100; ++n) felt = bench.tick();
  EXPECT_EQ(felt.force_n, (Vec3{0.0, 2.0, 0.0})) << "whoever has left stops nothing";
  EXPECT_EQ(felt.faults, 0U);
}

TEST(BridgeLawClay, SaysItsNameAndGivesNothingOfASimulators) {
  EXPECT_STREQ(bridge_law_name(BridgeLaw::clay), "clay");
  BridgeProxy proxy;
  proxy.header.flags = kBridgeContact | kBridgePlane;
  proxy.plane_point_mm = {0.0, 5.0, 0.0};
  proxy.direct_force_n = {0.0, 5.0, 0.0};
  EXPECT_EQ(bridge_force(BridgeLaw::clay, {}, {}, {}, proxy), Vec3{});
}

}  // namespace
}  // namespace argil::haptics
