// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstdint>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// Why a tick's force is not the one that was computed. Bits, whose values recordings keep.
enum ServoFault : std::uint32_t {
  kServoSound = 0,
  // These cut the force to zero at once.
  kForceNotFinite = 1U << 0,  ///< the scene or the coupling gave a force that is not finite
  kDeviceLost = 1U << 1,      ///< the device is unplugged or not homed
  kClockJumped = 1U << 2,     ///< the clock stood still or went back, or skipped 50 ms and 3 ticks
  kStopping = 1U << 3,        ///< the servo is ending
  kHalted = 1U << 10,         ///< the emergency stop: until Servo::resume
  kSimulatorStop = 1U << 12,  ///< the simulator behind a bridge says stop, or has left
  // These ramp it out.
  kWindowStale = 1U << 4,    ///< the clay has not answered for too long
  kOutsideWindow = 1U << 5,  ///< the tool has left the window
  kClayStopped = 1U << 6,    ///< the clay's thread has ended
  kWaiting = 1U << 9,        ///< the clay has not published a window yet; the usual start
  kClutched = 1U << 11,      ///< the clutch is held: the handle moves and the tool does not
  // These only tell that a limit was at work.
  kForceLimited = 1U << 7,
  kSlewLimited = 1U << 8,
};
/// Faults that cut the force to zero at once.
inline constexpr std::uint32_t kCutFaults =
    kForceNotFinite | kDeviceLost | kClockJumped | kStopping | kHalted | kSimulatorStop;
/// Faults that ramp the force out.
inline constexpr std::uint32_t kRampFaults =
    kWindowStale | kOutsideWindow | kClayStopped | kWaiting | kClutched;

/// One sentence for the lowest bit set: what happened and the remedy. "" for none.
const char* fault_text(std::uint32_t faults) noexcept;

/// Makes `force_n` no longer than `most_n`, its direction kept; true when it was longer.
///
/// Units    most_n: >= 0, may be infinite; NaN limits nothing.
/// Threads  Realtime; pure.
bool shorten(Vec3& force_n, double most_n) noexcept;

struct SafetyOptions {
  /// Usual 8, the limit of the Falcon's usual driver; >= 0, and 0 lets no force through.
  double most_force_n = 8.0;
  /// How fast the force may change; usual 2000, > 0. Less feels soft on impact and, as a lag, costs
  /// stability.
  double most_slew_n_per_s = 2000.0;
  /// Time of the ramp at the start and after a fault; usual 0.5, >= 0. 0 starts with a knock.
  double ramp_in_s = 0.5;
  /// Time of the ramp on a fault of kRampFaults; usual 0.02, >= 0.
  double ramp_out_s = 0.02;
};

/// The last thing before the device: whatever comes in, the force that goes out is finite, no
/// larger than most_force_n, changes no faster than most_slew_n_per_s unless it is cut to zero, and
/// is zero while there is a fault (SafetyGate.*, SafetyGateProperty.*).
///
/// Threads  Realtime; always checked, in every build.
class SafetyGate {
 public:
  explicit SafetyGate(const SafetyOptions& options) noexcept : options_(options) {
    assert(options.most_force_n >= 0.0 && options.most_slew_n_per_s > 0.0);
    assert(options.ramp_in_s >= 0.0 && options.ramp_out_s >= 0.0);
  }

  /// The force that may go out in a tick of `period_s` (>= 0). `faults` says what is wrong so far,
  /// and gets kForceNotFinite and the bits of the limits that were at work.
  Vec3 limit(const Vec3& wanted_n, std::uint32_t& faults, double period_s) noexcept;

  /// Of the ramps: 0 (no force) to 1.
  double gain() const noexcept { return gain_; }

 private:
  SafetyOptions options_;
  double gain_ = 0.0;
  Vec3 good_n_;  ///< the last force without a fault, which is what a ramp fades out
  Vec3 given_n_;
};

}  // namespace argil::haptics
