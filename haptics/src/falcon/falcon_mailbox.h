// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

#include "argil/core/triple_buffer.h"
#include "argil/haptics/falcon/falcon_status.h"
#include "argil/haptics/servo/device.h"

#include "falcon/link_clock.h"

namespace argil::haptics {

/// What the servo gets.
struct FalconReading {
  DeviceReading reading{{}, 0, false};
  double round_trip_s = 0.0;  ///< 0: not known yet
};

/// What the servo gives.
struct FalconForce {
  Vec3 force_n;
  bool is_cut = true;   ///< no force at all, at once; else the grip's weight is held as well
  double time_s = 0.0;  ///< when it was given, by the clock of the device
};

/// What passes between a Falcon's own thread, the servo's and the main one; the newest counts.
struct FalconMailbox {
  TripleBuffer<FalconReading> readings;  ///< device to servo
  TripleBuffer<FalconForce> forces;      ///< servo to device
  TripleBuffer<FalconStatus> statuses;   ///< device to main
};

/// The servo's end of it.
///
/// Threads  Realtime.
class FalconPort final : public Device {
 public:
  /// Both must outlive it; mass and damping are the calibration's. `clock` is the session's, and is
  /// asked for the time on the servo's thread.
  FalconPort(FalconMailbox& mailbox, LinkClock& clock, double mass_kg, double damping_n_s_per_m,
             double most_force_n) noexcept
      : mailbox_(mailbox),
        clock_(clock),
        traits_{mass_kg, damping_n_s_per_m, most_force_n, 0.0, kQuantumMm} {
    assert(mass_kg > 0.0 && damping_n_s_per_m >= 0.0 && most_force_n >= 0.0);
  }

  DeviceReading read(double now_s) noexcept override;
  void write(const Vec3& force_n) noexcept override { give(force_n, false); }
  void cut() noexcept override { give({}, true); }
  DeviceTraits traits(double period_s) const noexcept override;

 private:
  static constexpr double kQuantumMm = 0.06;  ///< of the tip in one count, at most

  void give(const Vec3& force_n, bool is_cut) noexcept;

  FalconMailbox& mailbox_;
  LinkClock& clock_;
  DeviceTraits traits_;
  double last_s_ = 0.0;  ///< of the servo's clock, when a reading was new
};

}  // namespace argil::haptics
