// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/haptics/servo/device.h"
#include "argil/haptics/servo/servo.h"

namespace argil::haptics {

/// A run of the servo as it is kept: every tick, and a line that says what was run.
struct Recording {
  /// One line: what is needed to set up the same run again.
  std::string note;
  /// Numbered 1, 2, 3 ...
  std::vector<ServoTick> ticks;
};

/// Writes ticks to a file while the servo runs: the servo pushes them into `ring`, and a thread of
/// the recorder's own takes them out and writes. The file is CSV: a comment line with the note, a
/// header that names the units, a line for each tick with every number to its last bit.
///
/// Threads  `ring` is for the servo's thread; the rest for the thread that made it.
/// Memory   the ring: 2^15 ticks (8 MiB), half a minute at 1 kHz.
class Recorder {
 public:
  /// Starts writing to FILE.part, which `finish` renames to FILE.
  ///
  /// Errors  disk when it cannot be made; bad_input for a note of more than one line.
  static Result<std::unique_ptr<Recorder>> start(const std::filesystem::path& file,
                                                 const std::string& note);
  ~Recorder();  ///< without `finish`: removes FILE.part
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Where the servo puts its ticks.
  ServoTickRing& ring() noexcept { return ring_; }

  /// Waits until all is written and synced.
  ///
  /// Errors  disk, also where the ring did not take a tick: a record with gaps cannot be replayed.
  ///         FILE.part is then gone, and FILE is as it was.
  Result<void> finish();

  std::uint64_t written() const noexcept { return written_; }  ///< ticks; valid after `finish`
  /// Ticks that the ring did not take.
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }

 private:
  Recorder(std::filesystem::path file, int descriptor);
  void run(const std::string& head);

  std::filesystem::path file_;
  int descriptor_;
  ServoTickRing ring_;
  std::atomic<bool> stop_ = false;
  int errno_ = 0;  ///< of the first write that failed
  std::uint64_t written_ = 0;
  std::thread thread_;
};

/// The same file at once, for runs on virtual time, which no writer could keep up with.
///
/// Errors  as Recorder's; interrupted by `progress`: FILE.part is then gone, and FILE is as it was.
Result<void> write_recording(const std::filesystem::path& file, const Recording& recording,
                             const Progress& progress = {});

/// Reads what a Recorder or write_recording wrote.
///
/// Errors  disk when it cannot be read; bad_input naming the line that is not a tick, or where
///         ticks are missing because the recorder's ring was full.
Result<Recording> read_recording(const std::filesystem::path& file);

/// A device that gives the positions of a recording again, one a reading, and compares the forces
/// it is given with the recorded ones, bit by bit. After the last tick it is not ready.
///
/// Threads  as Device.
class ReplayDevice final : public Device {
 public:
  /// `recording` must outlive it; `traits` as the recorded device had them.
  ReplayDevice(const Recording& recording, const DeviceTraits& traits)
      : recording_(recording), traits_(traits) {}

  DeviceReading read(double now_s) noexcept override;
  void write(const Vec3& force_n) noexcept override;
  DeviceTraits traits(double) const noexcept override { return traits_; }

  /// How many ticks were given another force than the recorded one.
  std::uint64_t different() const noexcept { return different_; }
  /// The number of the first of them; 0: none.
  std::uint64_t first_different() const noexcept { return first_different_; }

 private:
  const Recording& recording_;
  DeviceTraits traits_;
  std::size_t next_ = 0;
  bool is_answered_ = true;
  std::uint64_t different_ = 0;
  std::uint64_t first_different_ = 0;
};

/// Ticks the servo once for every tick of the recording, at its time, halted where it was. `before`
/// is called with the recorded tick before each, so that a clay can publish the window that was
/// felt then.
///
/// Errors  the first of `before`; interrupted by `progress`.
Result<void> replay(Servo& servo, const Recording& recording,
                    const std::function<Result<void>(const ServoTick&)>& before = {},
                    const Progress& progress = {});

}  // namespace argil::haptics
