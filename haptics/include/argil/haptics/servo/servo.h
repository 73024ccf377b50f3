// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "argil/core/spsc_ring.h"
#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/servo/adaptive_damping.h"
#include "argil/haptics/servo/coupling.h"
#include "argil/haptics/servo/device.h"
#include "argil/haptics/servo/governor.h"
#include "argil/haptics/servo/passivity.h"
#include "argil/haptics/servo/position_filter.h"
#include "argil/haptics/servo/safety_gate.h"
#include "argil/haptics/servo/velocity_filter.h"

namespace argil::haptics {

struct ServoOptions {
  /// Of a tick; usual 1 ms, 0.25 to 20 ms. Longer is less stiff.
  double period_s = 1e-3;
  CouplingOptions coupling;
  GovernorOptions governor;
  /// Fixed by default. Adaptive: of use to a direct coupling (docs/stability.md).
  DampingOptions damping;
  SafetyOptions safety;
  PassivityOptions passivity;
  /// Of the velocity filter; >= 0. 0: raw differences, which buzz.
  double velocity_lag_s = VelocityFilter::kUsualLagS;
  /// Eq. 6 to 8, before the scene; off by default: it makes contact less stable
  /// (docs/stability.md), so that the governor counts its lag as delay.
  std::optional<PositionFilterOptions> position_filter;
};

/// All of one tick, as it is recorded. Trivially copyable.
struct ServoTick {
  /// 1, 2, 3 ...
  std::uint64_t number = 0;
  /// The servo's clock when the tick began.
  double time_s = 0.0;
  /// As the device gave it, unfiltered.
  Vec3 position_mm;
  /// Where the handle is felt, and to be shown: filtered by eq. 6 to 8 where that is asked for,
  /// else position_mm. Not in a recording: a replay works it out again.
  Vec3 felt_mm;
  std::uint32_t buttons = 0;
  /// The device answered.
  bool is_ready = false;
  Vec3 velocity_mm_per_s;
  Vec3 proxy_mm;
  /// The scene's aid, such as guidance. Not in recordings.
  Vec3 aid_n;
  /// How much of `wanted_n`, and so of the aid, the device was given, 0 to 1. Not in recordings.
  double given_part = 0.0;
  /// Before the safety gate, with the aid.
  Vec3 wanted_n;
  /// What the device was given.
  Vec3 force_n;
  /// The governor's.
  double most_stiffness_n_per_m = 0.0;
  /// What AdaptiveDamping adds to the contact. Not in recordings.
  double added_damping_n_s_per_m = 0.0;
  /// Bits of ServoFault.
  std::uint32_t faults = kServoSound;
  /// Of the clay; 0 where there is none.
  WindowStamp window;
};
using ServoTickRing = SpscRing<ServoTick>;

/// The force loop. A tick goes: device, position filter, scene through the coupling under the
/// governor, adaptive damping, the scene's aid, passivity, safety gate, device, recorder. The same
/// code runs on a virtual and on the real clock: who calls `tick` says what time it is.
///
/// Errors   none to return: what is wrong stands in ServoTick::faults, and the force is then zero
///          or ramps to it (kCutFaults, kRampFaults).
/// Threads  Realtime: `tick` and `stop` are for one thread; no allocation, lock, or system call of
///          its own (ServoLoopRealtime.*). `halt` and `resume` are for any thread and wait-free.
/// Cost     0.3 us besides the scene and the device.
class Servo {
 public:
  /// `recording`: where every tick goes, dropped and counted when it is full; may be null. Device,
  /// scene and ring must outlive the servo.
  Servo(Device& device, ForceScene& scene, const ServoOptions& options,
        ServoTickRing* recording = nullptr) noexcept;
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;
  ~Servo() { stop(); }

  /// One tick at `now_s`. A time that has not risen since the last tick, or has risen by more than
  /// 50 ms and three ticks, is kClockJumped.
  ServoTick tick(double now_s) noexcept;

  /// Gives the device zero; called again by the destructor. A tick after it ramps in anew.
  void stop() noexcept;

  /// The emergency stop: from the next tick on the device is given zero, whatever else happens,
  /// until `resume`, after which the force ramps in. Meanwhile nothing works the clay.
  void halt() noexcept { is_halted_.store(true, std::memory_order_relaxed); }
  /// Ends `halt`.
  void resume() noexcept { is_halted_.store(false, std::memory_order_relaxed); }

  const ServoOptions& options() const noexcept { return options_; }
  /// The faults of all ticks so far.
  std::uint32_t faults_seen() const noexcept { return faults_seen_; }
  const PassivityController& passivity() const noexcept { return passivity_; }

 private:
  double elapsed(double now_s, std::uint32_t& faults) noexcept;
  void forget_motion() noexcept;
  void feel(const DeviceReading& reading, double elapsed_s, ServoTick& tick) noexcept;
  double given_part(const ServoTick& tick) const noexcept;

  Device& device_;
  ForceScene& scene_;
  ServoOptions options_;
  ServoTickRing* recording_;
  Coupling coupling_;
  Governor governor_;
  AdaptiveDamping damping_;
  PassivityController passivity_;
  SafetyGate gate_;
  VelocityFilter velocity_;
  std::optional<PositionFilter> filter_;
  double filter_lag_s_ = 0.0;  ///< 0 without one
  std::uint64_t number_ = 0;
  double last_s_ = 0.0;
  Vec3 last_position_mm_;
  bool has_position_ = false;
  double given_part_ = 0.0;  ///< of the last force that was wanted
  std::uint32_t faults_seen_ = kServoSound;
  std::atomic<bool> is_halted_ = false;
};

}  // namespace argil::haptics
