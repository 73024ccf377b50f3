// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <vector>

#include "argil/haptics/analysis/hold_judgement.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/hand_model.h"
#include "argil/haptics/simulation/sim_falcon.h"

namespace argil::haptics {

/// A simulated hand at a simulated Falcon in a scene: what is held, and for how long.
struct HoldTest {
  FalconModel device;
  HandModel hand = hand_model(Hand::arm);
  ServoOptions servo;
  /// At least one key, times ascending.
  std::vector<HandKey> plan;
  /// From the start until the hold is watched, the whole plan included; usual 3, >= 0. Without
  /// friction slow decays need 5.
  double settle_s = 3.0;
  /// How long it is watched; usual 1, > 0.
  double watch_s = 1.0;
};

struct HoldTestResult {
  /// Of the true positions and the forces really held.
  HoldJudgement judgement;
  /// Over the watch.
  Vec3 mean_position_mm;
  /// Of the motors, over the watch.
  Vec3 mean_force_n;
  /// The most energy that the servo had given to the hand at any time.
  double most_given_nmm = 0.0;
  /// Bits of ServoFault, of all ticks.
  std::uint32_t faults = kServoSound;
  /// All ticks, the settling included.
  std::vector<ServoTick> ticks;
  /// At each tick.
  std::vector<Vec3> true_position_mm;
  /// From each tick to the next.
  std::vector<Vec3> held_force_n;
};

/// Runs the test on virtual time. `stop`, when given, ends it early.
///
/// Determinism  same test: same bits.
/// Threads      any; allocates.
/// Cost         0.5 us of CPU for each tick of 1 ms, and the scene's own.
HoldTestResult run_hold_test(ForceScene& scene, const HoldTest& test,
                             ServoObserver* observer = nullptr,
                             const std::atomic<bool>* stop = nullptr);

/// Keys of a hand that comes from 5 mm in front of the surface within 50 ms and presses: a firm
/// tap, since friction would hide a cycle from a gentle one.
///
/// Units  place_mm: where the handle comes to rest. direction: unit length, into the matter.
std::vector<HandKey> press_plan(const Vec3& place_mm, const Vec3& direction, double press_n);

/// A servo with nothing between scene and device, as docs/stability.md compares remedies with: the
/// scene's own force up to 9 N, no ramps, no governor, velocities straight from differences.
ServoOptions bare_servo(double period_s) noexcept;

}  // namespace argil::haptics
