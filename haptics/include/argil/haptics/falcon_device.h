// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/device.h"
#include "argil/haptics/falcon_calibration.h"
#include "argil/haptics/falcon_status.h"

namespace argil::haptics {

/// From a force to its answer, until the device's own exchanges were measured.
inline constexpr double kFalconUsualDelayS = 1.5e-3;

/// The longest period of whoever gives it forces: its watchdog lets go of one that is older than
/// 2.5 ms, and a machine is late by some of that.
inline constexpr double kFalconMostPeriodS = 2e-3;

struct FalconOptions {
  std::string serial;  ///< of the one meant; "": the first that can be opened
  /// Sent when none runs; "": what ARGIL_FALCON_FIRMWARE names, or none.
  std::filesystem::path firmware;
  FalconCalibration calibration;
  double most_force_n = 8.0;          ///< 0 (never any force) to 8
  double most_slew_n_per_s = 2000.0;  ///< 500 to 1e5; as SafetyOptions
  /// Lets the chip send each reply at once instead of within a millisecond. Untested on hardware.
  bool flushes_at_packet_end = false;
};

/// What is wrong with them, but for the files and the calibration. Errors  bad_input.
Result<void> check_falcon(const FalconOptions& options);

/// A real Novint Falcon, over USB, on a thread of its own that exchanges packets as fast as the
/// device answers (500 to 1000 a second) whatever the servo does.
///
/// Buttons  of a reading: bit 0 the large one in the centre, which works the clay, 1 right, 2
/// front,
///          3 left.
/// Safety   zero words go out first, last, with every fault and while the grip is not homed. No
///          force before all three arms are homed and the grip was pulled out once; none for 50 ms
///          after a jump of the encoders. The force is limited in size and slew, its direction kept
///          where the motors saturate; it is none when the servo cuts it (halted, stopping, a fault
///          of its own), within 5 ms of the last `write` when no new one comes (the servo hangs),
///          whether the device answers or not (FalconThread.LetsGo*), and while a reply is 15 ms
///          late. A killed process relies on the firmware, which drops the motors when packets
///          stop.
/// Threads  read and write are the servo's: wait-free. The rest is for one other thread, which
///          opened it.
/// Cost     open a few ms, and the start of its firmware 1 to 2 s on the device's thread; one USB
///          packet each way for each exchange.
class FalconDevice final : public Device {
 public:
  /// Opens it and begins to probe; `look` says how far it has come.
  /// Errors  bad_input of check_falcon and of the firmware's file, before the device is touched;
  /// device, with the
  ///         remedy, when it cannot be opened; internal when the system gives no thread.
  static Result<std::unique_ptr<FalconDevice>> open(const FalconOptions& options);
  ~FalconDevice() override;  ///< zero force, then lets it go

  DeviceReading read(double now_s) noexcept override;
  /// Holds the grip's weight as well. Again after kFalconMostPeriodS at the latest, the same force
  /// too, or it fades.
  void write(const Vec3& force_n) noexcept override;
  void cut() noexcept override;
  DeviceTraits traits(double period_s) const noexcept override;

  /// The newest status.
  const FalconStatus& look() noexcept;

  /// After a fault: opens it anew and begins to probe. Else nothing.
  void home() noexcept;

  /// As ServoThread's, of its own thread.
  const std::string& priority_refusal() const noexcept;

 private:
  struct Impl;
  explicit FalconDevice(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A Falcon on the bus.
struct AttachedFalcon {
  int bus = 0;
  int address = 0;
  std::string serial;                        ///< "" when it could not be opened to be asked
  FalconFault obstacle = FalconFault::none;  ///< why it cannot be used
};

/// All that are attached; opens each for a moment. None is a success.
/// Errors  device when the machine has no USB.
Result<std::vector<AttachedFalcon>> attached_falcons();

}  // namespace argil::haptics
