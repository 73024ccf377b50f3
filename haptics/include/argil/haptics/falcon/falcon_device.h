// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/falcon/falcon_calibration.h"
#include "argil/haptics/falcon/falcon_status.h"
#include "argil/haptics/servo/device.h"

namespace argil::haptics {

/// Delay from a force to its answer that is assumed until the device's own exchanges are measured.
inline constexpr double kFalconUsualDelayS = 1.5e-3;

/// The longest period of a servo that gives it forces: its watchdog lets go of a force older than
/// 2.5 ms, and a machine may be late by some of that.
inline constexpr double kFalconMostPeriodS = 2e-3;

struct FalconOptions {
  /// Serial number of the one that is meant; "": the first that can be opened.
  std::string serial;
  /// File of the firmware that is sent when none runs; "": what ARGIL_FALCON_FIRMWARE names, or
  /// none.
  std::filesystem::path firmware;
  FalconCalibration calibration;
  /// Usual 8, 0 (never any force) to 8.
  double most_force_n = 8.0;
  /// Usual 2000, 500 to 1e5; as SafetyOptions.
  double most_slew_n_per_s = 2000.0;
  /// Lets the chip send each reply at once instead of within a millisecond. Untested on hardware.
  bool flushes_at_packet_end = false;
};

/// Checks the ranges of FalconOptions; files and calibration are checked when they are read.
///
/// Errors  bad_input naming the option, its value and its range.
Result<void> check_falcon(const FalconOptions& options);

/// A real Novint Falcon, over USB, on a thread of its own that exchanges packets as fast as the
/// device answers (500 to 1000 a second) whatever the servo does.
///
/// Buttons  of a reading: bit 0 the large one in the centre, which works the clay, 1 right,
///          2 front, 3 left.
/// Safety   zero words go out first, last, with every fault and while the grip is not homed. No
///          force before all three arms are homed and the grip was pulled out once; none for 50 ms
///          after a jump of the encoders. The force is limited in size and slew, and keeps its
///          direction where the motors saturate. There is none when the servo cuts it (halted,
///          stopping, a fault of its own), within 5 ms of the last `write` when no new one comes
///          (the servo hangs), whether the device answers or not (FalconThread.LetsGo*), and while
///          a reply is 15 ms late. When the process is killed only the firmware is left, which
///          drops the motors when packets stop.
/// Threads  read, write, cut and traits are the servo's: wait-free. The rest is for one other
///          thread, the one that opened it.
/// Cost     open a few ms, and the start of its firmware 1 to 2 s on the device's thread; one USB
///          packet each way for each exchange.
class FalconDevice final : public Device {
 public:
  /// Opens it and begins to probe; `look` says how far it has come.
  ///
  /// Errors  bad_input of check_falcon and of the firmware's file, before the device is touched;
  ///         device, with the remedy, when it cannot be opened; internal when the system gives no
  ///         thread.
  static Result<std::unique_ptr<FalconDevice>> open(const FalconOptions& options);
  /// Gives zero force, then lets the device go.
  ~FalconDevice() override;

  DeviceReading read(double now_s) noexcept override;
  /// Gives a force, and holds the grip's weight as well. It has to be given again within
  /// kFalconMostPeriodS, even the same one, or it fades.
  void write(const Vec3& force_n) noexcept override;
  void cut() noexcept override;
  DeviceTraits traits(double period_s) const noexcept override;

  /// How it stands now.
  const FalconStatus& look() noexcept;

  /// After a fault: opens it anew and begins to probe. Without one it does nothing.
  void home() noexcept;

  /// As ServoThread::priority_refusal, of the device's own thread.
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
  /// "" when it could not be opened to be asked.
  std::string serial;
  /// Why it cannot be used.
  FalconFault obstacle = FalconFault::none;
};

/// All that are attached; opens each for a moment. None attached is a success.
///
/// Errors  device when the machine has no USB.
Result<std::vector<AttachedFalcon>> attached_falcons();

}  // namespace argil::haptics
