// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "argil/core/clay_pulse.h"
#include "argil/core/result.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/coupling.h"
#include "argil/haptics/falcon_device.h"
#include "argil/haptics/guided_hand.h"
#include "argil/haptics/hand_model.h"
#include "argil/haptics/histogram.h"
#include "argil/haptics/recording.h"
#include "argil/haptics/scene_placed.h"
#include "argil/haptics/servo.h"
#include "argil/haptics/tool_force.h"

namespace argil::haptics {

enum class RigDevice {
  sim,     ///< a simulated Falcon in the simulated hand that HapticRig::lead leads
  replay,  ///< the positions and buttons of a recording, a tick each, and then none
  falcon,  ///< a real one: HapticRig::falcon says whether it can be felt yet
};

/// What to feel, and with what. The ranges are what check_rig refuses outside of.
struct RigOptions {
  RigDevice device = RigDevice::sim;
  std::filesystem::path replay_file;  ///< of RigDevice::replay; as read_recording wants it
  Hand hand = Hand::arm;              ///< of RigDevice::sim: light, arm or firm
  Vec3 start_mm;  ///< of RigDevice::sim: where the hand begins, device mm, in the Falcon's reach
  FalconOptions falcon;  ///< of RigDevice::falcon

  double period_s = 1e-3;  ///< of a tick: 0.25 to 20 ms, on a real Falcon to kFalconMostPeriodS
  /// direct: the report's scenes as the report has them, of which the hard ones vibrate; on a real
  /// Falcon only those that do not.
  CouplingKind coupling = CouplingKind::indirect;
  /// k_c, 50 to 3000; usual 1500. What is felt is less where the governor says so.
  double coupling_stiffness_n_per_m = 1500.0;

  std::string scene = "clay";  ///< "clay", or a name of scene_catalogue

  // Of the clay.
  ForceTool tool{ToolShape::ellipsoid, {4.0, 4.0, 4.0}, {}, {}, {}, {}};  ///< radii 0.2 to 50 mm
  /// surface_force_n 0 to 8, exponent 1 to 8, skin_mm 0.5 to 50, clamp_ratio 1.01 to 20,
  /// viscosity_force_n 0 to 8, viscosity_s_per_mm 0 to 1. With the direct coupling the clay's
  /// stiffness in the hand must be within the limit of a sampled loop besides.
  ForceMaterial material;
  ForceLaw law = ForceLaw::energy;
  /// Scale 0.05 to 20, where in the clay the device's 0 lies, and which axis is up there. The
  /// report's scenes are in the device's frame and have none of that.
  Placement placement;
  const ClayPulse* pulse = nullptr;  ///< of the clay's thread; must outlive the run; may be null
};

/// What is wrong with them, naming the option, its value and its range. Reads no file.
/// Errors  bad_input.
Result<void> check_rig(const RigOptions& options);

/// The stiffest that a material gets, in the clay, N/m: where the clamp sets in, for a point.
double most_stiffness_n_per_m(const ForceMaterial& material) noexcept;

/// How the rig stands, at most 10 ms old.
struct RigSnapshot {
  ServoTick tick;       ///< the newest one; number 0: none yet. In the device's frame
  Placement placement;  ///< as the clutch has left it
  Vec3 tool_mm;         ///< the proxy, in the scene's frame
  bool is_clutched = false;

  std::uint64_t late_ticks = 0;        ///< of this run, as ServoRun has them
  std::uint64_t skipped_ticks = 0;     ///< the same
  std::uint32_t faults = kServoSound;  ///< of all ticks of this run
  Histogram lateness;                  ///< us, of this run
  std::uint64_t dropped_samples = 0;   ///< that the ring to the clay did not take, of all runs
};

/// One for each 10 ms, for plots.
struct RigPoint {
  double time_s = 0.0;   ///< the servo's clock, which starts anew with each run
  Vec3 position_mm;      ///< device's frame
  Vec3 force_n;          ///< the largest since the last point: no peak is lost
  double rate_hz = 0.0;  ///< of the ticks since the last point
};

/// A device, something to feel and the servo between them, on a thread of its own, for a program
/// with a window: it is led by the main thread, which sees how it stands and never waits for it.
///
/// The clay's side (a ClayWorker) takes samples from `ring` and publishes into `channel`; both stay
/// the same from run to run, so the clay's thread need not notice that the device was changed.
///
/// Threads  all for one thread, the main one, but ring and channel, whose other ends are the
///          clay's. The servo's ticks take no lock and make no heap call
///          (HapticRigRealtime.*). Works with no real-time priority and says why there is none.
/// Cost     start 1 ms, and what reading a recording or opening a Falcon takes; stop up to a period
/// and a recording's
///          sync; the rest microseconds. 4 MiB, and 8 MiB while it records.
class HapticRig {
 public:
  static constexpr double kPlottedS = 5.0;

  HapticRig();
  ~HapticRig();  ///< stops; what is being recorded is finished
  HapticRig(const HapticRig&) = delete;
  HapticRig& operator=(const HapticRig&) = delete;

  /// Starts, with another device, scene or material too: what ran before is stopped first. The
  /// force ramps in over half a second. A halt stays one.
  ///
  /// A real Falcon runs from the moment it could be opened, and gives forces when it is active.
  /// Errors  as check_rig and read_recording: what ran before runs on; as `stop`, as
  ///         FalconDevice::open, and internal when the system gives no thread: nothing runs then.
  Result<void> start(const RigOptions& options);

  /// Gives zero force, ends the thread, the stroke and the recording. Again: nothing.
  /// Errors  as stop_recording. It is stopped all the same.
  Result<void> stop();

  bool is_running() const noexcept { return run_ != nullptr; }

  /// The red stop: the force is zero from the servo's next tick until `resume`, after which it
  /// ramps in over half a second. Also while nothing runs: what is started then gives none.
  void halt() noexcept;
  void resume() noexcept;
  bool is_halted() const noexcept { return is_halted_; }

  /// Holds the clutch, or lets it go: PlacedScene says what that does. Let go by `start`.
  void set_clutched(bool clutched) noexcept;

  /// Leads the simulated hand; a target in the device's frame. Does nothing to other devices.
  void lead(const HandTarget& target) noexcept { hand_.set(target); }

  /// Records from the next tick on; `note`: one line, what is needed to set the run up again.
  /// Errors  as Recorder::start; bad_input when nothing runs or it records already.
  Result<void> start_recording(const std::filesystem::path& file, const std::string& note);
  /// Ends it and waits until all is written; nothing when it did not record.
  /// Errors  as Recorder::finish; disk when the recorder lost ticks: FILE then stays as it was.
  Result<void> stop_recording();
  bool is_recording() const noexcept { return recorder_ != nullptr; }

  /// How it stands now; of the last run when none runs.
  const RigSnapshot& look();
  /// The last kPlottedS of this run, oldest first, as of the last `look`.
  const std::deque<RigPoint>& points() const noexcept { return points_; }
  /// How the real Falcon stands, now; null when none runs.
  const FalconStatus* falcon();
  /// After a fault of the real Falcon: as FalconDevice::home.
  void home_falcon();
  /// The recording of RigDevice::replay has ended, as of the last `look`.
  bool is_replay_over() const noexcept;

  /// "" with real-time priority and locked memory, of a real Falcon's thread too, else why not and
  /// the remedy; of the last run.
  const std::string& priority_refusal() const noexcept { return priority_refusal_; }
  /// Those of the last `start` that succeeded.
  const RigOptions& options() const noexcept { return options_; }

  ToolSampleRing& ring() noexcept { return ring_; }       ///< the clay's side pops
  WindowChannel& channel() noexcept { return channel_; }  ///< the clay's side writes

 private:
  struct Run;

  ToolSampleRing ring_;
  WindowChannel channel_;
  GuidedHand hand_;
  RigOptions options_;
  bool is_halted_ = false;
  std::uint64_t samples_ = 0;  ///< indices given to samples by all runs
  RigSnapshot snapshot_;
  std::deque<RigPoint> points_;
  std::string priority_refusal_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Run> run_;
};

}  // namespace argil::haptics
