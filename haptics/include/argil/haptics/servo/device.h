// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "argil/core/vec3.h"

namespace argil::haptics {

struct DeviceReading {
  /// Of the handle about the middle of the workspace.
  Vec3 position_mm;
  /// Bit 0: the button that works the clay.
  std::uint32_t buttons = 0;
  /// False: lost, or not homed; position and buttons then mean nothing.
  bool is_ready = true;
};

/// What decides how stiff a device may feel.
struct DeviceTraits {
  /// Moved with the handle.
  double mass_kg = 0.0;
  /// Physical and viscous, with no hand on it.
  double damping_n_s_per_m = 0.0;
  /// What the motors can give.
  double most_force_n = 0.0;
  /// From a force written to the force felt, beyond the hold of a tick.
  double delay_s = 0.0;
  /// Largest step of a measured position.
  double quantum_mm = 0.0;
};

/// DeviceTraits::delay_s in whole ticks of `period_s` (> 0): how old the force is that is held.
int delay_ticks(const DeviceTraits& traits, double period_s) noexcept;

/// A haptic device: positions out, forces in. The servo sees no more of it than this.
///
/// Errors   none to return: a device that is lost says so by DeviceReading::is_ready.
/// Threads  Realtime: `read` and `write` are for the servo's thread; noexcept, no allocation, no
///          lock. They may make the system calls that the hardware needs.
class Device {
 public:
  virtual ~Device() = default;
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// The newest position. `now_s`: the servo's clock, to which a simulated device moves.
  virtual DeviceReading read(double now_s) noexcept = 0;

  /// The force to give from now on, until the next one. Finite: the servo has limited it.
  virtual void write(const Vec3& force_n) noexcept = 0;

  /// No force until the next `write`: none of the device's own either, such as one against the
  /// handle's weight, and at once, past any slew limit.
  virtual void cut() noexcept { write({}); }

  /// For a servo whose tick is `period_s`.
  virtual DeviceTraits traits(double period_s) const noexcept = 0;
};

inline int delay_ticks(const DeviceTraits& traits, double period_s) noexcept {
  return static_cast<int>(std::lround(traits.delay_s / period_s));
}

}  // namespace argil::haptics
