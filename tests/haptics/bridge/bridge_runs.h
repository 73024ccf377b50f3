// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/bridge_world.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/sim_falcon.h"

namespace argil::haptics::scenes {

/// A hand at a simulated Falcon that a bridge couples to a stand-in simulator, on virtual time.
struct BridgeRun {
  BridgeWorldOptions world;
  BridgeTerms terms;
  GuidanceOptions guidance;
  Hand hand = Hand::arm;
  std::vector<HandKey> plan;
  double seconds = 5.0;
  /// Called after each tick, to meddle with the simulator or the session.
  std::function<void(double time_s, BridgeWorld& world)> after = [](double, BridgeWorld&) {};

  BridgeRun() { terms.is_forced = true; }
};

struct BridgeRan {
  std::vector<BridgeRow> rows;
  std::vector<Vec3> true_mm;  ///< of the handle at each tick
  BridgeCounts counts;
};

/// Waits 5 mm above y = 0 until the servo has ramped in, taps it and presses.
inline std::vector<HandKey> pressing(double press_n = 3.0) {
  std::vector<HandKey> plan = press_plan({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, press_n);
  for (HandKey& key : plan) key.time_s += 0.5;
  plan.insert(plan.begin(), plan.front());
  plan.front().time_s = 0.0;
  return plan;
}

/// The same, and then goes `way_mm` along x, in two seconds from the first on.
inline std::vector<HandKey> sliding(double way_mm) {
  std::vector<HandKey> plan = pressing();
  HandKey key = plan.back();
  key.time_s = 1.5;
  plan.push_back(key);
  key.time_s = 3.5;
  key.place_mm.x += way_mm;
  plan.push_back(key);
  return plan;
}

inline BridgeRan run_bridge(const BridgeRun& run) {
  BridgeRan ran;
  BridgeWorld world(run.world);
  BridgeSession session(world, run.terms);
  BridgeScene scene(session, run.guidance);
  SimFalcon device({}, hand_model(run.hand), HandPlan(run.plan));
  Servo servo(device, scene, bridge_servo(run.terms.servo_period_s));
  BridgeDriver driver(session, world, [&](const BridgeRow& row) {
    ran.rows.push_back(row);
    ran.true_mm.push_back(device.true_position_mm());
    run.after(row.tick.time_s, world);
  });
  VirtualClock clock;
  const std::atomic<bool> goes_on = false;
  run_servo(servo, clock, run.seconds, goes_on, &driver);
  ran.counts = session.counts();
  return ran;
}

/// What a hold was like in the rows from `from_s` on.
struct BridgeHold {
  double mean_n = 0.0;       ///< along y
  double deviation_n = 0.0;  ///< the largest from the mean
  double rms_n = 0.0;
  double drag_n = 0.0;  ///< the largest force across y
  double depth_mm = 0.0;
  int breaks = 0;  ///< from some force to none
};

inline BridgeHold hold_of(const BridgeRan& ran, double from_s, double to_s = 1e9) {
  BridgeHold hold;
  std::vector<double> forces;
  double square = 0.0;
  for (std::size_t n = 0; n < ran.rows.size(); ++n) {
    const ServoTick& tick = ran.rows[n].tick;
    if (tick.time_s < from_s || tick.time_s > to_s) continue;
    if (!forces.empty() && forces.back() > 0.0 && !(tick.force_n.y > 0.0)) ++hold.breaks;
    forces.push_back(tick.force_n.y);
    hold.depth_mm -= ran.true_mm[n].y;
    hold.drag_n = std::max(hold.drag_n, std::hypot(tick.force_n.x, tick.force_n.z));
  }
  const auto count = static_cast<double>(forces.size());
  for (const double force : forces) hold.mean_n += force / count;
  for (const double force : forces) {
    hold.deviation_n = std::max(hold.deviation_n, std::abs(force - hold.mean_n));
    square += (force - hold.mean_n) * (force - hold.mean_n) / count;
  }
  hold.rms_n = std::sqrt(square);
  hold.depth_mm /= count;
  return hold;
}

}  // namespace argil::haptics::scenes
