// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"

namespace argil::haptics {

struct DeviceReading {
  Vec3 position_mm;           ///< of the handle about the middle of the workspace
  std::uint32_t buttons = 0;  ///< bit 0: the one that works the clay
  bool is_ready = true;       ///< false: lost, or not homed; position and buttons mean nothing then
};

/// What of a device decides how stiff it may feel. Units: kg, N s/m, N, s, mm.
struct DeviceTraits {
  double mass_kg = 0.0;
  double damping_n_s_per_m = 0.0;  ///< physical and viscous, with no hand on it
  double most_force_n = 0.0;       ///< what the motors can give
  double delay_s = 0.0;            ///< from a force written to the force felt, beyond the hold
  double quantum_mm = 0.0;         ///< largest step of a position
};

/// A thing to hold: positions out, forces in. The servo sees no more of it than this.
///
/// Threads  Realtime: `read` and `write` are for the servo's thread; noexcept, no allocation, no
///          lock. They may make the system calls that the hardware needs.
class Device {
 public:
  virtual ~Device() = default;
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// The newest position. `now_s` is the servo's clock: a simulated device moves up to it.
  virtual DeviceReading read(double now_s) noexcept = 0;

  /// The force to give from now on, until the next one. The servo has limited it already.
  virtual void write(const Vec3& force_n) noexcept = 0;

  /// Nothing from now on, until the next `write`: no force of the device's own either, such as one
  /// against the handle's weight, and at once, past any limit of slew.
  virtual void cut() noexcept { write({}); }

  /// For one tick of `period_s`.
  virtual DeviceTraits traits(double period_s) const noexcept = 0;
};

}  // namespace argil::haptics
