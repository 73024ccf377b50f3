// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "argil/core/clay_heartbeat.h"
#include "argil/core/result.h"
#include "argil/core/tool_sample.h"
#include "argil/core/window_channel.h"
#include "argil/haptics/falcon/falcon_device.h"
#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/scene/scene_placed.h"
#include "argil/haptics/servo/adaptive_damping.h"
#include "argil/haptics/servo/coupling.h"
#include "argil/haptics/servo/guidance.h"
#include "argil/haptics/servo/histogram.h"
#include "argil/haptics/servo/position_filter.h"
#include "argil/haptics/servo/recording.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/simulation/guided_hand.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {

enum class RigDevice {
  /// A simulated Falcon in the simulated hand that HapticRig::lead leads.
  sim,
  /// The positions and buttons of a recording, one a tick, and then none.
  replay,
  /// A real one: HapticRig::falcon says whether it can be felt yet.
  falcon,
};

/// What to feel, and with what. check_rig refuses what is outside the ranges.
struct RigOptions {
  RigDevice device = RigDevice::sim;
  /// Of RigDevice::replay; as read_recording takes it.
  std::filesystem::path replay_file;
  /// Of RigDevice::sim: light, arm or firm.
  Hand hand = Hand::arm;
  /// Of RigDevice::sim: where the hand begins, device mm, in the Falcon's reach.
  Vec3 start_mm;
  /// Of RigDevice::falcon.
  FalconOptions falcon;

  /// Of a tick; usual 1 ms, 0.25 to 20 ms, on a real Falcon to kFalconMostPeriodS.
  double period_s = 1e-3;
  /// Direct: the scenes as the Falcon report has them, of which the hard ones vibrate; on a real
  /// Falcon only those that do not.
  CouplingKind coupling = CouplingKind::indirect;
  /// k_c; usual 1500, 50 to 3000. What is felt is less where the governor says so.
  double coupling_stiffness_n_per_m = 1500.0;
  /// Eq. 6 to 8: every scene is felt, and the tool is seen, at the filtered place, which is never
  /// farther from the handle than lambda (ServoTick::felt_mm). Usually none: its lag is delay, for
  /// which a coupling is held back and a direct one may be refused.
  std::optional<PositionFilterOptions> position_filter;
  /// Adaptive: a contact in which the handle swings is damped more, of use to a direct coupling.
  DampingKind damping = DampingKind::fixed;

  /// "clay", or a name of scene_catalogue.
  std::string scene = "clay";
  /// Parameters of that scene, by name, which are not to be usual (SceneParameter); the clay has
  /// none.
  std::map<std::string, double> scene_settings;
  /// A vibration of at most 0.1 N while the tool slides: of what of the clay is too fine for the
  /// tool's windows (SurfaceTexture), and over other scenes a texture of 1 mm (VibroScene).
  bool has_vibro = false;

  // Of the clay.

  /// Radii 0.2 to 50 mm.
  ForceTool tool{ToolShape::ellipsoid, {4.0, 4.0, 4.0}, {}, {}, {}, {}};
  /// surface_force_n 0 to 8, exponent 1 to 8, skin_mm 0.5 to 50, clamp_ratio 1.01 to 20,
  /// viscosity_force_n 0 to 8, viscosity_s_per_mm 0 to 1. With the direct coupling the clay's
  /// stiffness in the hand must be within the limit of a sampled loop besides.
  ForceMaterial material;
  ForceLaw law = ForceLaw::energy;
  /// Weights of contact and viscosity, touching and working (eq. 3 to 5).
  ForceMix mix;
  /// ClaySceneOptions::mix_ramp_s.
  double mix_ramp_s = ModeBlend::kUsualRampS;
  /// ClaySceneOptions::own_cut_mm; 0 to 50.
  double own_cut_mm = 0.0;
  /// Scale 0.05 to 20, where in the clay the device's 0 lies, and which axis is up there. The
  /// Falcon report's scenes are in the device's frame and take none of that.
  Placement placement;
  /// Of the clay's thread; must outlive the run; may be null.
  const ClayHeartbeat* heartbeat = nullptr;

  /// Along a path in the frame of what is felt: of the clay where that is the scene. Its scale is
  /// `placement`'s, whatever stands there. Ranges: check_guidance.
  GuidanceOptions guidance;
};

/// Checks the ranges of RigOptions. Reads no file.
///
/// Errors  bad_input naming the option, its value and its range.
Result<void> check_rig(const RigOptions& options);

/// The greatest stiffness of a material in the clay, N/m: that of the point force where the clamp
/// sets in.
double most_stiffness_n_per_m(const ForceMaterial& material) noexcept;

/// The stiffest that the direct coupling of such a rig is steady with, N/m: (b + c) / (T / 2 +
/// t_d), the lag of a position filter counted as delay.
double most_direct_stiffness_n_per_m(const RigOptions& options) noexcept;

/// How the rig stands, at most 10 ms old.
struct RigSnapshot {
  /// The newest one, in the device's frame; number 0: none yet.
  ServoTick tick;
  /// As the clutch has left it.
  Placement placement;
  /// The proxy, in the scene's frame.
  Vec3 tool_mm;
  bool is_clutched = false;
  GuidanceState guidance;

  /// Of this run; as ServoRun::late_ticks.
  std::uint64_t late_ticks = 0;
  /// Of this run; as ServoRun::skipped_ticks.
  std::uint64_t skipped_ticks = 0;
  /// Of all ticks of this run.
  std::uint32_t faults = kServoSound;
  /// Of this run, us; as ServoRun has them.
  Histogram lateness;
  Histogram window_age;
  /// Samples that the ring to the clay did not take, of all runs.
  std::uint64_t dropped_samples = 0;
};

/// What is plotted, one for each 10 ms.
struct RigPoint {
  /// The servo's clock, which starts anew with each run.
  double time_s = 0.0;
  /// In the device's frame.
  Vec3 position_mm;
  /// The largest since the last point, so that no peak is lost.
  Vec3 force_n;
  /// Rate of the ticks since the last point.
  double rate_hz = 0.0;
};

/// A device, something to feel and the servo between them, on a thread of its own, for a program
/// with a window: the main thread leads it, sees how it stands, and never waits for it.
///
/// The clay's side (a ClayWorker) takes samples from `ring` and publishes into `channel`; both stay
/// the same from run to run, so that the clay's thread need not notice a change of device.
///
/// Threads  all for one thread, the main one, but ring and channel, whose other ends are the
///          clay's. The servo's ticks take no lock and make no heap call (HapticRigRealtime.*).
///          Works with no real-time priority and says why there is none.
/// Cost     start 1 ms, and what reading a recording or opening a Falcon takes; stop up to a period
///          and the sync of a recording; the rest microseconds.
/// Memory   5 MiB, and 8 MiB more while it records.
class HapticRig {
 public:
  /// How far back `points` goes.
  static constexpr double kPlottedS = 5.0;

  HapticRig();
  ~HapticRig();  ///< stops; what is being recorded is finished
  HapticRig(const HapticRig&) = delete;
  HapticRig& operator=(const HapticRig&) = delete;

  /// Starts, also with another device, scene or material: what ran before is stopped first. The
  /// force ramps in over half a second. A halted rig stays halted.
  ///
  /// A real Falcon runs from the moment it could be opened, and gives forces when it is active.
  ///
  /// Errors  as check_rig and read_recording: what ran before runs on; as `stop`, as
  ///         FalconDevice::open, and internal when the system gives no thread: nothing runs then.
  Result<void> start(const RigOptions& options);

  /// Gives zero force, ends the thread, the stroke and the recording. Does nothing when stopped.
  ///
  /// Errors  as stop_recording. It is stopped all the same.
  Result<void> stop();

  bool is_running() const noexcept { return run_ != nullptr; }

  /// The emergency stop: the force is zero from the servo's next tick until `resume`, after which
  /// it ramps in over half a second. Also while nothing runs: what is then started gives no force.
  void halt() noexcept;
  /// Ends `halt`.
  void resume() noexcept;
  bool is_halted() const noexcept { return is_halted_; }

  /// Holds the clutch, or lets it go: PlacedScene says what that does. `start` lets it go.
  void set_clutched(bool clutched) noexcept;

  /// Leads the simulated hand to a target in the device's frame. Does nothing to other devices.
  void lead(const HandTarget& target) noexcept { hand_.set(target); }

  /// Records from the next tick on; `note`: one line, what is needed to set up the run again.
  ///
  /// Errors  as Recorder::start; bad_input when nothing runs or it records already.
  Result<void> start_recording(const std::filesystem::path& file, const std::string& note);
  /// Ends the recording and waits until all is written; does nothing when there is none.
  ///
  /// Errors  as Recorder::finish.
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
  /// Whether the recording of RigDevice::replay has ended, as of the last `look`.
  bool is_replay_over() const noexcept;

  /// "" with real-time priority and locked memory, of a real Falcon's thread too; else what was
  /// refused and the remedy. Of the last run.
  const std::string& priority_refusal() const noexcept { return priority_refusal_; }
  /// Of the last `start` that succeeded.
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
