// SPDX-License-Identifier: GPL-3.0-or-later
// What the three laws do with a slow simulator: a hand presses, slides and goes free over a
// stand-in at 60 and 200 Hz, k = 1500 N/m, one tick of delay in the device.
#include "argil/haptics/bridge/bridge_run.h"

#include <cstring>

#include <gtest/gtest.h>

#include "haptics/bridge/bridge_runs.h"

namespace argil::haptics {
namespace {

using scenes::BridgeHold;
using scenes::BridgeRan;
using scenes::BridgeRun;

constexpr double kPressN = 4.0;
constexpr double kDampingNsPerM = 3.0;

BridgeHold press_bridge(BridgeLaw law, double rate_hz, Hand hand = Hand::light) {
  BridgeRun run;
  run.terms.law = law;
  run.terms.spring.damping_n_s_per_m = kDampingNsPerM;
  run.world.rate_hz = rate_hz;
  run.hand = hand;
  run.plan = scenes::pressing(kPressN);
  return scenes::hold_of(scenes::run_bridge(run), 3.0);
}

void expect_holds(const BridgeHold& hold) {
  EXPECT_LT(hold.deviation_n, 0.01);
  EXPECT_EQ(hold.breaks, 0);
  EXPECT_LE(hold.depth_mm, 1.2 * 1000.0 * kPressN / 1500.0);
  EXPECT_GT(hold.mean_n, 0.5 * kPressN);
}

TEST(BridgePress, PlaneAndIndirectHoldAtSixtyHertz) {
  for (const Hand hand : {Hand::push, Hand::light, Hand::arm, Hand::firm}) {
    expect_holds(press_bridge(BridgeLaw::plane, 60.0, hand));
    expect_holds(press_bridge(BridgeLaw::indirect, 60.0, hand));
  }
}

TEST(BridgePress, DirectChattersAtSixtyHertz) {
  const BridgeHold hold = press_bridge(BridgeLaw::direct, 60.0);
  EXPECT_GT(hold.rms_n, 1.0);
  EXPECT_GT(hold.deviation_n, 1.0);
  EXPECT_GT(hold.breaks, 10);
}

TEST(BridgePress, DirectHoldsAtTwoHundredHertz) {
  for (const Hand hand : {Hand::light, Hand::arm, Hand::firm}) {
    expect_holds(press_bridge(BridgeLaw::direct, 200.0, hand));
  }
}

/// The largest force across the true normal while the hand slides.
double drag(BridgeLaw law, BridgeShape shape, double way_mm) {
  BridgeRun run;
  run.terms.law = law;
  run.world.shape = shape;
  run.plan = scenes::sliding(way_mm);
  const BridgeRan ran = scenes::run_bridge(run);
  const BridgeWorld world(run.world);
  double most = 0.0;
  double moved = 0.0;
  for (const BridgeRow& row : ran.rows) {
    if (row.tick.time_s < 1.6 || row.tick.time_s > 3.4) continue;
    const Vec3 normal = world.nearest(row.tick.position_mm).plane_normal;
    EXPECT_GT(length(row.tick.force_n), 0.5) << "it slides in contact";
    most = std::max(most, length(row.tick.force_n - dot(row.tick.force_n, normal) * normal));
    moved = row.tick.position_mm.x;
  }
  EXPECT_GT(moved, 0.5 * way_mm);
  return most;
}

TEST(BridgeSlide, PlaneDragsNotAtAllOnTheFlatAndHardlyOnABall) {
  EXPECT_LE(drag(BridgeLaw::plane, BridgeShape::floor, 40.0), 1e-9);
  EXPECT_LE(drag(BridgeLaw::plane, BridgeShape::ball, 10.0), 0.05);
}

TEST(BridgeSlide, IndirectDragsByTheProxysLag) {
  // k v T: 1500 N/m, 20 mm/s and a frame of 1/60 s: 0.5 N.
  EXPECT_GT(drag(BridgeLaw::indirect, BridgeShape::floor, 40.0), 0.2);
}

TEST(BridgeFree, NothingIsFelt) {
  for (const BridgeLaw law : {BridgeLaw::direct, BridgeLaw::indirect, BridgeLaw::plane}) {
    BridgeRun run;
    run.terms.law = law;
    run.plan.resize(3);
    run.plan[0].place_mm = {-30.0, 10.0, 0.0};
    run.plan[1].time_s = 1.0;
    run.plan[1].place_mm = {30.0, 10.0, 20.0};
    run.plan[2].time_s = 1.5;
    run.plan[2].place_mm = {0.0, 40.0, -20.0};
    run.seconds = 2.0;
    for (const BridgeRow& row : scenes::run_bridge(run).rows) {
      ASSERT_EQ(row.tick.force_n, Vec3{}) << bridge_law_name(law);
    }
  }
}

TEST(BridgeRunGolden, SameBitsEveryTime) {
  BridgeRun run;
  run.plan = scenes::sliding(10.0);
  run.world.shape = BridgeShape::ball;
  run.seconds = 3.0;
  const BridgeRan first = scenes::run_bridge(run);
  for (int again = 0; again < 2; ++again) {
    const BridgeRan next = scenes::run_bridge(run);
    ASSERT_EQ(next.rows.size(), first.rows.size());
    for (std::size_t n = 0; n < first.rows.size(); ++n) {
      ASSERT_EQ(next.rows[n].tick.force_n, first.rows[n].tick.force_n) << n;
      ASSERT_EQ(next.rows[n].tick.position_mm, first.rows[n].tick.position_mm) << n;
    }
  }
}

/// How far from the path a hand that means to be 10 mm beside it ends.
double distance_from_path(GuidanceKind kind) {
  BridgeRun run;
  run.guidance.kind = kind;
  run.guidance.path_mm = {{-40.0, 20.0, 0.0}, {40.0, 20.0, 0.0}};
  run.plan.resize(2);
  run.plan[0].place_mm = {-20.0, 30.0, 0.0};
  run.plan[1] = run.plan[0];
  run.plan[1].time_s = 3.0;
  run.plan[1].place_mm.x = 20.0;
  run.seconds = 4.0;
  return scenes::run_bridge(run).true_mm.back().y - 20.0;
}

TEST(BridgeGuidance, LeadsAYieldingHandToThePathAndPushesItOff) {
  // A yielding arm of 135 N/m meets 60 N/m: 10 mm * 135 / 195 and 135 / 75, friction aside.
  EXPECT_NEAR(distance_from_path(GuidanceKind::none), 10.0, 1.2);
  EXPECT_NEAR(distance_from_path(GuidanceKind::direct), 6.9, 1.0);
  EXPECT_NEAR(distance_from_path(GuidanceKind::indirect), 18.0, 2.5);
}

}  // namespace
}  // namespace argil::haptics
