// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "argil/core/spsc_ring.h"
#include "argil/core/vec3.h"
#include "argil/haptics/coupling.h"
#include "argil/haptics/device.h"
#include "argil/haptics/governor.h"
#include "argil/haptics/passivity.h"
#include "argil/haptics/position_filter.h"
#include "argil/haptics/safety_gate.h"
#include "argil/haptics/scene.h"
#include "argil/haptics/velocity_filter.h"

namespace argil::haptics {

struct ServoOptions {
  double period_s = 1e-3;  ///< of a tick: 0.25 to 20 ms; longer is less stiff
  CouplingOptions coupling;
  GovernorOptions governor;
  SafetyOptions safety;
  PassivityOptions passivity;
  double velocity_lag_s = VelocityFilter::kUsualLagS;  ///< >= 0; 0: raw differences, which buzz
  /// Eq. 6 to 8, before the scene; off by default: it makes contact less stable
  /// (docs/stability.md).
  std::optional<PositionFilterOptions> position_filter;
};

/// All of one tick, as it is recorded. Trivially copyable.
struct ServoTick {
  std::uint64_t number = 0;  ///< 1, 2, 3 ...
  double time_s = 0.0;       ///< the servo's clock when the tick began
  Vec3 position_mm;          ///< as read
  std::uint32_t buttons = 0;
  bool is_ready = false;  ///< the device answered
  Vec3 velocity_mm_per_s;
  Vec3 proxy_mm;
  Vec3 wanted_n;                        ///< before the safety gate
  Vec3 force_n;                         ///< what the device was given
  double most_stiffness_n_per_m = 0.0;  ///< the governor's
  std::uint32_t faults = kServoSound;
  WindowStamp window;  ///< of the clay; 0 where there is none
};
using ServoTickRing = SpscRing<ServoTick>;

/// The force loop: device, position filter, scene through the coupling under the governor,
/// passivity, safety gate, device, recorder. The same code for a virtual and for the real clock:
/// who calls `tick` says what time it is.
///
/// Threads  Realtime: `tick` and `stop` are for one thread; no allocation, lock, or system call of
///          its own (ServoLoopRealtime.*). `halt` and `resume` are for any thread and wait-free.
///          Device, scene and ring must outlive it.
/// Cost     0.3 us besides the scene and the device.
class Servo {
 public:
  /// `recording`: where every tick goes, dropped and counted when it is full; may be null.
  Servo(Device& device, ForceScene& scene, const ServoOptions& options,
        ServoTickRing* recording = nullptr) noexcept;
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;
  ~Servo() { stop(); }

  /// One tick at `now_s`.
  ServoTick tick(double now_s) noexcept;

  /// Gives the device zero; called again by the destructor. A tick after it ramps in anew.
  void stop() noexcept;

  /// The red stop: from the next tick on the device is given zero, whatever else happens, until
  /// `resume`, after which the force ramps in. Meanwhile nothing works the clay.
  void halt() noexcept { is_halted_.store(true, std::memory_order_relaxed); }
  void resume() noexcept { is_halted_.store(false, std::memory_order_relaxed); }

  const ServoOptions& options() const noexcept { return options_; }
  std::uint32_t faults_seen() const noexcept { return faults_seen_; }  ///< of all ticks
  const PassivityController& passivity() const noexcept { return passivity_; }

 private:
  double elapsed(double now_s, std::uint32_t& faults) noexcept;
  void forget_motion() noexcept;
  void feel(const DeviceReading& reading, double elapsed_s, ServoTick& tick) noexcept;

  Device& device_;
  ForceScene& scene_;
  ServoOptions options_;
  ServoTickRing* recording_;
  Coupling coupling_;
  Governor governor_;
  PassivityController passivity_;
  SafetyGate gate_;
  VelocityFilter velocity_;
  std::optional<PositionFilter> filter_;
  std::uint64_t number_ = 0;
  double last_s_ = 0.0;
  Vec3 last_position_mm_;
  bool has_position_ = false;
  std::uint32_t faults_seen_ = kServoSound;
  std::atomic<bool> is_halted_ = false;
};

}  // namespace argil::haptics
