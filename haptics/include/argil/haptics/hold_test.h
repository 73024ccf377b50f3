// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <vector>

#include "argil/haptics/hand_model.h"
#include "argil/haptics/hold_judgement.h"
#include "argil/haptics/scene.h"
#include "argil/haptics/servo.h"
#include "argil/haptics/servo_run.h"
#include "argil/haptics/sim_falcon.h"

namespace argil::haptics {

/// A simulated hand at a simulated Falcon in a scene: what is held, and for how long.
struct HoldTest {
  FalconModel device;
  HandModel hand = hand_model(Hand::arm);
  ServoOptions servo;
  std::vector<HandKey> plan;  ///< at least one key
  double settle_s = 3.0;      ///< from the start until the hold is watched, a whole plan included
  double watch_s = 1.0;       ///< how long it is watched
};

struct HoldTestResult {
  HoldJudgement judgement;      ///< of the true positions and the forces really held
  Vec3 mean_position_mm;        ///< over the watch
  Vec3 mean_force_n;            ///< of the motors, over the watch
  double most_given_nmm = 0.0;  ///< most energy that the servo had given to the hand
  std::uint32_t faults = kServoSound;
  std::vector<ServoTick> ticks;        ///< all of them
  std::vector<Vec3> true_position_mm;  ///< at each tick
  std::vector<Vec3> held_force_n;      ///< from each tick to the next
};

/// Runs it on virtual time. Deterministic: same test, same bits.
/// Cost  about 0.5 us of CPU for each tick of 1 ms and the scene's own.
/// `stop`, when given, ends it early.
HoldTestResult run_hold_test(ForceScene& scene, const HoldTest& test,
                             ServoObserver* observer = nullptr,
                             const std::atomic<bool>* stop = nullptr);

/// Keys of a hand that comes from 5 mm before the surface and presses: `place_mm` is where the
/// handle comes to rest, `direction` (unit) points into the matter.
std::vector<HandKey> press_plan(const Vec3& place_mm, const Vec3& direction, double press_n);

/// A servo as theory B simulated it: nothing but the scene's own force, 9 N, no ramps, no governor,
/// velocities straight from differences of positions.
ServoOptions bare_servo(double period_s) noexcept;

}  // namespace argil::haptics
