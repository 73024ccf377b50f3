// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triple_buffer.h"
#include "argil/haptics/device.h"
#include "argil/haptics/falcon_status.h"

namespace argil::haptics {

/// What the servo gets.
struct FalconReading {
  DeviceReading reading{{}, 0, false};
  double round_trip_s = 0.0;  ///< 0: not known yet
};

/// What the servo gives.
struct FalconForce {
  Vec3 force_n;
  bool is_cut = true;  ///< no force at all, and at once; else the grip's weight is held as well
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
  /// Both must outlive it; mass and damping are the calibration's.
  FalconPort(FalconMailbox& mailbox, double mass_kg, double damping_n_s_per_m,
             double most_force_n) noexcept
      : mailbox_(mailbox), traits_{mass_kg, damping_n_s_per_m, most_force_n, 0.0, kQuantumMm} {}

  DeviceReading read(double now_s) noexcept override;
  void write(const Vec3& force_n) noexcept override { give({force_n, false}); }
  void cut() noexcept override { give({}); }
  DeviceTraits traits(double period_s) const noexcept override;

 private:
  static constexpr double kQuantumMm = 0.06;  ///< the tip's way in one count, at most

  void give(const FalconForce& force) noexcept;

  FalconMailbox& mailbox_;
  DeviceTraits traits_;
  double last_s_ = 0.0;  ///< of the servo's clock, when a reading was new
};

}  // namespace argil::haptics
