// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_shown.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/bridge_world.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/simulation/sim_falcon.h"

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
  BridgeShownScene scene{session, floor, {2.0, {5.0, 0.0, 20.0}, true}};
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

TEST(BridgeShownScene, TurnsUpToUpAndScales) {
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

TEST(BridgeShownScene, GivesTheClaysForceUpwards) {
  ClayBench bench;
  bench.handle.position_mm = {0.0, -6.0, 0.0};  // 2 mm deep at twice the size
  const SceneForce felt = bench.tick();
  EXPECT_EQ(felt.force_n, (Vec3{0.0, 2.0, 0.0}));
  EXPECT_EQ(felt.stiffness_n_per_m, 2000.0) << "of the hand, whose millimetre is two of the clay";
}

TEST(BridgeShownScene, DoesNotCareWhatTheSimulatorSaysOrWhetherItDoes) {
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

TEST(BridgeShownScene, StopsWhenTheSimulatorSaysStop) {
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

/// A spring of the Falcon report of 400 N/m through a coupling of 500, swept by a hand beside a
/// simulator.
std::vector<ServoTick> sweep_spring(
    double rate_hz,
    const std::function<void(double, BridgeWorld&)>& after = [](double, BridgeWorld&) {}) {
  const SceneEntry& entry = *find_scene("spring");
  SceneValues values(entry.parameters);
  EXPECT_TRUE(values.set_all({{"k", 400.0}, {"c", 0.0}}).ok());
  const auto spring = entry.make(values);
  BridgeWorldOptions simulator;
  simulator.rate_hz = rate_hz;
  BridgeWorld world(simulator);
  BridgeTerms terms;
  terms.law = BridgeLaw::scene;
  BridgeSession session(world, terms);
  BridgeShownScene scene(session, *spring, {});
  std::vector<HandKey> plan(3);
  plan[1].time_s = 1.0;
  plan[1].place_mm = {25.0, 5.0, 0.0};
  plan[2].time_s = 2.0;
  plan[2].place_mm = {-25.0, 0.0, 5.0};
  SimFalcon device({}, hand_model(Hand::arm), HandPlan(std::move(plan)));
  ServoOptions options;
  options.coupling.stiffness_n_per_m = 500.0;
  Servo servo(device, scene, options);
  std::vector<ServoTick> ticks;
  BridgeDriver driver(session, world, [&](const BridgeRow& row) {
    ticks.push_back(row.tick);
    after(row.tick.time_s, world);
  });
  VirtualClock clock;
  const std::atomic<bool> goes_on = false;
  run_servo(servo, clock, 2.5, goes_on, &driver);
  EXPECT_GT(session.counts().proxies, static_cast<std::uint64_t>(2.0 * rate_hz));
  return ticks;
}

constexpr double kRampedS = 0.6;

TEST(BridgeShownSpring, IsTheSpringOfItsFormulaInSeriesWithTheCoupling) {
  const double felt_n_per_mm = 1e-3 * 400.0 * 500.0 / (400.0 + 500.0);
  double most_n = 0.0;
  for (const ServoTick& tick : sweep_spring(60.0)) {
    if (tick.time_s < kRampedS) continue;
    ASSERT_LT(length(tick.force_n + felt_n_per_mm * tick.position_mm), 2e-3) << tick.time_s;
    most_n = std::max(most_n, length(tick.force_n));
  }
  EXPECT_GT(most_n, 1.0);
}

TEST(BridgeShownSpring, HasTheSameBitsWhateverTheSimulatorsRate) {
  const std::vector<ServoTick> slow = sweep_spring(60.0);
  const std::vector<ServoTick> quick = sweep_spring(200.0);
  ASSERT_EQ(slow.size(), quick.size());
  for (std::size_t n = 0; n < slow.size(); ++n) {
    ASSERT_EQ(slow[n].force_n, quick[n].force_n) << n;
    ASSERT_EQ(slow[n].position_mm, quick[n].position_mm) << n;
  }
}

TEST(BridgeShownSpring, StopsForTheSimulatorAndComesBack) {
  const std::vector<ServoTick> ticks = sweep_spring(
      100.0, [](double time_s, BridgeWorld& world) { world.stop(time_s > 1.0 && time_s < 1.4); });
  for (const ServoTick& tick : ticks) {
    // A frame of the simulator's until it is said, and another until it is taken back.
    if (tick.time_s > 1.012 && tick.time_s < 1.4) {
      ASSERT_EQ(tick.force_n, Vec3{}) << tick.time_s;
      ASSERT_NE(tick.faults & kSimulatorStop, 0U) << tick.time_s;
    }
    if (tick.time_s > 0.9 && tick.time_s < 1.0) {
      ASSERT_GT(length(tick.force_n), 0.5);
    }
  }
  EXPECT_GT(length(ticks.back().force_n), 0.5) << "it is felt again";
}

TEST(BridgeLawShown, SaysItsNameAndGivesNothingOfASimulators) {
  EXPECT_STREQ(bridge_law_name(BridgeLaw::clay), "clay");
  EXPECT_STREQ(bridge_law_name(BridgeLaw::scene), "scene");
  BridgeProxy proxy;
  proxy.header.flags = kBridgeContact | kBridgePlane;
  proxy.plane_point_mm = {0.0, 5.0, 0.0};
  proxy.direct_force_n = {0.0, 5.0, 0.0};
  EXPECT_EQ(bridge_force(BridgeLaw::clay, {}, {}, {}, proxy), Vec3{});
  EXPECT_EQ(bridge_force(BridgeLaw::scene, {}, {}, {}, proxy), Vec3{});
}

/// The rule k T < 2 b is of a simulator's force; what is ours has the governor.
TEST(BridgeLawShown, TakesAnySimulatorHoweverSlow) {
  BridgeWorldOptions slow;
  slow.rate_hz = 10.0;
  for (const BridgeLaw law : {BridgeLaw::clay, BridgeLaw::scene, BridgeLaw::indirect}) {
    BridgeWorld world(slow);
    BridgeTerms terms;
    terms.law = law;
    terms.spring.stiffness_n_per_m = 3000.0;
    terms.device_damping_n_s_per_m = 1.0;
    BridgeSession session(world, terms);
    session.receive(0.0);
    EXPECT_EQ(session.has_simulator(), is_own_force(law)) << bridge_law_name(law);
  }
}

}  // namespace
}  // namespace argil::haptics
