// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "argil/haptics/falcon/falcon_kinematics.h"
#include "argil/haptics/servo/device.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {

/// How a position becomes the number that the servo reads.
enum class Encoder {
  /// No rounding.
  exact,
  /// Each coordinate to multiples of quantum_mm.
  uniform,
  /// Through the real arms: each arm's angle to whole counts, then forward kinematics (default).
  kinematic,
};

/// A Novint Falcon as mass, friction and rounding. The usual values are those measured in the
/// Falcon report, corrected for what the loop adds to them (docs/theory.md, "Falcon").
struct FalconModel {
  /// Moved with the handle; > 0.
  double mass_kg = 0.4589;
  /// Viscous; >= 0.
  double damping_n_s_per_m = 3.0;
  /// Coulomb; >= 0. The real unit's is at most 0.3.
  double friction_n = 0.15;
  /// Where the motors saturate, the direction being kept; > 0.
  double most_force_n = 9.0;
  Encoder encoder = Encoder::kinematic;
  /// Of Encoder::uniform; > 0.
  double quantum_mm = 0.06;
  /// The arms' end stops: what the handle reached in the Falcon report. It stops dead there. Not
  /// empty.
  Box3 reach_mm{{-50.0, -70.0, -70.0}, {50.0, 80.0, 80.0}};
  /// From a force written to the force held; 0 to SimFalcon::kMostDelayTicks.
  int delay_ticks = 1;
  /// Positions waver evenly by up to so many quanta or counts; >= 0.
  double jitter_counts = 0.0;
  /// Of the jitter and of where the encoder's zero lies.
  std::uint64_t seed = 1;
};

/// What the servo may know of it, when a tick takes `period_s`.
DeviceTraits traits_of(const FalconModel& model, double period_s) noexcept;

/// A Falcon without friction, with damping of 3.975 N s/m instead: the worst case for stability.
FalconModel frictionless_falcon() noexcept;

/// A simulated Falcon held by a simulated hand. It moves when it is read: from the last reading to
/// `now_s` under the force that is held meanwhile (zero-order hold).
///
/// Determinism  same plan, model, forces and times: same bits.
/// Accuracy  second order in steps of at most 0.1 ms, friction as an impulse: free oscillation
///           at 800 N/m within 1e-4 of the exact one (SimFalcon.OscillatesAsTheExactSolution).
/// Threads   Realtime, one thread. Constructing allocates.
/// Cost      0.3 us for each 0.1 ms; 1.5 us more for a kinematic reading.
class SimFalcon final : public Device {
 public:
  static constexpr int kMostDelayTicks = 16;

  /// Held by a hand that follows `plan`.
  SimFalcon(const FalconModel& model, const HandModel& hand, HandPlan plan);
  /// Held by a hand that does what `source` says, which must outlive the device.
  SimFalcon(const FalconModel& model, const HandModel& hand, HandSource& source);

  DeviceReading read(double now_s) noexcept override;
  void write(const Vec3& force_n) noexcept override;
  DeviceTraits traits(double period_s) const noexcept override;

  /// Pulls the plug, or puts it back: without it readings are not ready and forces do not arrive.
  void set_plugged(bool plugged) noexcept { is_plugged_ = plugged; }

  // What no real device tells: for judging a run.
  const Vec3& true_position_mm() const noexcept { return position_mm_; }
  const Vec3& true_velocity_mm_per_s() const noexcept { return velocity_mm_per_s_; }
  const Vec3& held_force_n() const noexcept { return held_n_; }  ///< what the motors give

 private:
  SimFalcon(const FalconModel& model, const HandModel& hand, std::unique_ptr<HandSource> plan);

  /// Damping (N s/m) and stiffness (N/m) of the hand along the direction it presses in, and across.
  struct Grip {
    double along_damping = 0.0;
    double along_stiffness = 0.0;
    double damping = 0.0;
    double stiffness = 0.0;
  };
  Grip grip_of(const HandIntent& intent) const noexcept;
  Vec3 hand_force(const HandIntent& intent, const Grip& grip) const noexcept;
  void move_to(double now_s) noexcept;
  void step(double time_s, double dt_s) noexcept;
  void kick(const HandIntent& intent, const Grip& grip, double dt_s) noexcept;
  Vec3 measured_position() noexcept;
  Vec3 position_by_arms() noexcept;
  double jitter() noexcept;

  FalconModel model_;
  HandModel hand_;
  std::unique_ptr<HandSource> plan_;  ///< when the device was given one to keep
  HandSource& source_;
  Vec3 position_mm_;
  Vec3 velocity_mm_per_s_;
  Vec3 held_n_;
  std::array<Vec3, kMostDelayTicks + 1> pending_n_{};  ///< newest first
  FalconKinematics kinematics_;
  Vec3 zero_offset_mm_;  ///< of the encoder's grid
  Vec3 measured_mm_;     ///< the last reading
  double time_s_ = 0.0;
  bool has_time_ = false;
  bool is_plugged_ = true;
  std::uint64_t random_;
};

}  // namespace argil::haptics
