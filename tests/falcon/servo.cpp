// SPDX-License-Identifier: GPL-3.0-or-later
// The servo, its coupling and its governor on the emulated device, through the real libusb: what is
// quiet on the simulated Falcon is quiet here, and what is not is not.
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/scene/scene_wall.h"

#include "falcon/driver.h"
#include "haptics/force/analytic_publisher.h"
#include "haptics/force/fields.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using test::Driver;

constexpr double kHomingS = 2.0;
const double kSettleS = argil::test::effort(1.5, 3.0);
constexpr double kWatchS = 1.0;

std::unique_ptr<ForceScene> make_usual(const char* scene) {
  const SceneEntry& entry = *find_scene(scene);
  return entry.make(SceneValues(entry.parameters));
}

/// The hand homes the grip, and then does what the plan says.
std::vector<HandKey> after_homing(const std::vector<HandKey>& plan) {
  std::vector<HandKey> whole = test::homing_plan();
  HandKey waits = plan.front();
  waits.press_n = 0.0;
  waits.time_s = kHomingS;
  whole.push_back(waits);
  waits.time_s += 1.0;  // until the servo has ramped in
  whole.push_back(waits);
  for (HandKey key : plan) {
    key.time_s += waits.time_s;
    if (key.time_s > whole.back().time_s) whole.push_back(key);
  }
  return whole;
}

struct Held {
  HoldJudgement judgement;
  double mean_force_n = 0.0;
  std::uint32_t late_faults = kServoSound;  ///< while it was judged
};

/// A press on the emulated device, judged as run_hold_test judges one on the simulated.
Held hold_on_falcon(ForceScene& scene, const HoldTest& test, ServoObserver* observer = nullptr) {
  test::DspOptions device;
  device.hand = test.hand;
  device.plan = after_homing(test.plan);
  Driver driver(device);
  EXPECT_EQ(driver.start(), FalconFault::none);
  Servo servo(driver.port, scene, test.servo);
  std::vector<Vec3> places;
  std::vector<Vec3> forces;
  Held held;
  const double begin_s = driver.now_s();
  const double watch_s = device.plan.back().time_s + kSettleS;
  const auto ticks = std::lround((watch_s + kWatchS - begin_s) / test.servo.period_s);
  for (long n = 0; n < ticks; ++n) {
    const double due_s = begin_s + static_cast<double>(n) * test.servo.period_s;
    driver.time.wait_until(due_s);
    const ServoTick tick = servo.tick(driver.now_s());
    if (observer != nullptr) observer->after_tick(tick);
    if (due_s < watch_s) continue;
    held.late_faults |= tick.faults;
    places.push_back(driver.true_place_mm());
    forces.push_back(driver.true_force_n());
    held.mean_force_n += length(forces.back());
  }
  held.mean_force_n /= static_cast<double>(forces.size());
  held.judgement = judge_hold(places, forces, test.servo.period_s);
  EXPECT_EQ(driver.session.state(), FalconState::active);
  EXPECT_EQ(driver.session.status().lost_replies, 0U);
  return held;
}

HoldTest press_at(const Vec3& place_mm, const Vec3& inward, Hand hand) {
  HoldTest test;
  test.hand = hand_model(hand);
  test.plan = press_plan(place_mm, inward, 3.0);
  return test;
}

constexpr Hand kHands[] = {Hand::push, Hand::light, Hand::arm, Hand::firm};
constexpr Vec3 kDown{0.0, -1.0, 0.0};

std::string told(Hand hand, const HoldJudgement& judged) {
  return std::string(hand_model(hand).name) + ": " + verdict_name(judged.verdict) + ", " +
         std::to_string(judged.position_pp_mm) + " mm, " + std::to_string(judged.force_pp_n) + " N";
}

TEST(FalconServo, AWallIsQuietAsOnTheSimulatedDevice) {
  for (const Hand hand : kHands) {
    const auto wall = make_usual("wall-rigid");
    const HoldTest test = press_at({0.0, WallOptions().offset_mm, 0.0}, kDown, hand);
    const Held held = hold_on_falcon(*wall, test);
    EXPECT_EQ(held.judgement.verdict, Verdict::quiet) << told(hand, held.judgement);
    EXPECT_EQ(held.judgement.verdict, run_hold_test(*wall, test).judgement.verdict);
    EXPECT_GT(held.mean_force_n, 1.0);
    EXPECT_EQ(held.late_faults, kServoSound);
  }
}

TEST(FalconServo, ABallIsQuietAsOnTheSimulatedDevice) {
  for (const Hand hand : kHands) {
    const auto ball = make_usual("sphere");
    const HoldTest test = press_at({0.0, 50.0, 0.0}, kDown, hand);
    const Held held = hold_on_falcon(*ball, test);
    EXPECT_EQ(held.judgement.verdict, Verdict::quiet) << told(hand, held.judgement);
    EXPECT_EQ(held.judgement.verdict, run_hold_test(*ball, test).judgement.verdict);
    EXPECT_GT(held.mean_force_n, 1.0) << told(hand, held.judgement);
    EXPECT_EQ(held.late_faults, kServoSound);
  }
}

/// Without coupling and governor the Falcon report's rigid wall cycles on both.
TEST(FalconServo, WhatCyclesOnTheSimulatedDeviceCyclesHere) {
  for (const Hand hand : {Hand::push, Hand::arm}) {
    const auto wall = make_usual("wall-rigid");
    HoldTest test = press_at({0.0, WallOptions().offset_mm, 0.0}, kDown, hand);
    test.servo = bare_servo(1e-3);
    const Held held = hold_on_falcon(*wall, test);
    EXPECT_EQ(held.judgement.verdict, Verdict::limit_cycle) << told(hand, held.judgement);
    EXPECT_EQ(run_hold_test(*wall, test).judgement.verdict, Verdict::limit_cycle);
  }
}

/// A ball of clay that answers each sample at once, as a thread that is fast enough would.
class Clay final : public ServoObserver {
 public:
  Clay() : publisher(channel), scene(options(), samples, channel) {}

  void after_tick(const ServoTick& /*tick*/) override {
    ToolSample sample;
    bool is_new = false;
    while (samples.pop(sample)) is_new = true;
    if (!is_new) return;
    publisher.publish(fields::ball(kBallMm), fields::ball_tool(4.0, sample.position_mm), 4.0,
                      sample.index, sample.time_s);
  }

  static constexpr double kBallMm = 30.0;

 private:
  static ClaySceneOptions options() {
    ClaySceneOptions made;
    made.tool = fields::ball_tool(4.0, {});
    return made;
  }

 public:
  ToolSampleRing samples{1024};
  WindowChannel channel;
  fields::AnalyticPublisher publisher;
  ClayScene scene;
};

/// Usually the two hands between which the others lie.
std::vector<Hand> hands_at_clay() {
  return argil::test::effort<std::vector<Hand>>({Hand::push, Hand::firm},
                                                {std::begin(kHands), std::end(kHands)});
}

TEST(FalconServo, ClayIsQuietAsOnTheSimulatedDevice) {
  for (const Hand hand : hands_at_clay()) {
    HoldTest test = press_at({0.0, Clay::kBallMm, 0.0}, kDown, hand);
    Clay felt;
    const Held held = hold_on_falcon(felt.scene, test, &felt);
    EXPECT_EQ(held.judgement.verdict, Verdict::quiet) << told(hand, held.judgement);
    EXPECT_GT(held.mean_force_n, 0.5);
    EXPECT_EQ(held.late_faults, kServoSound);
    Clay simulated;
    EXPECT_EQ(held.judgement.verdict,
              run_hold_test(simulated.scene, test, &simulated).judgement.verdict);
  }
}

}  // namespace
}  // namespace argil::haptics
