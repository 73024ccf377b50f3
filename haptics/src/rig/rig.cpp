// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/rig/rig.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <system_error>
#include <utility>

#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/scene/scene_clay.h"
#include "argil/haptics/scene/scene_vibro.h"
#include "argil/haptics/servo/guided_scene.h"
#include "argil/haptics/servo/servo_run.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "rig/rig_watch.h"

namespace argil::haptics {
namespace {

/// Five seconds of samples: the clay may be busy with a large dab for as long.
constexpr std::size_t kRingSamples = 1024;

/// The rest is as it comes: governor and safety gate are not the caller's to weaken.
ServoOptions servo_options(const RigOptions& options) {
  ServoOptions servo;
  servo.period_s = options.period_s;
  servo.coupling.kind = options.coupling;
  servo.coupling.stiffness_n_per_m = options.coupling_stiffness_n_per_m;
  servo.position_filter = options.position_filter;
  servo.damping.kind = options.damping;
  return servo;
}

ClaySceneOptions clay_options(const RigOptions& options, std::uint64_t samples_before) {
  ClaySceneOptions clay;
  clay.tool = options.tool;
  clay.material = options.material;
  clay.law = options.law;
  clay.mix = options.mix;
  clay.mix_ramp_s = options.mix_ramp_s;
  clay.own_cut_mm = options.own_cut_mm;
  if (options.has_vibro) clay.texture.emplace();
  // A hand of the same speed moves further through a clay that is scaled down.
  const double scale = options.placement.scale;
  clay.margin_mm = resting_margin_mm(options.tool) * std::max(1.0, scale);
  // The same force moves `scale` times as far there: so much more is a joule of the hand's, and so
  // much faster the handle.
  clay.account.power_mw *= scale;
  clay.account.most_nmm *= scale;
  clay.account.device_damping_n_s_per_m /= scale;
  clay.heartbeat = options.heartbeat;
  clay.samples_before = samples_before;
  return clay;
}

Result<std::unique_ptr<Device>> make_device(const RigOptions& options, GuidedHand& hand,
                                            const Recording& replayed) {
  switch (options.device) {
    case RigDevice::replay:
      return std::unique_ptr<Device>(
          new ReplayDevice(replayed, traits_of(FalconModel(), options.period_s)));
    case RigDevice::falcon: {
      auto opened = FalconDevice::open(options.falcon);
      if (!opened) return opened.error();
      return std::unique_ptr<Device>(std::move(opened).value());
    }
    case RigDevice::sim:
      break;
  }
  return std::unique_ptr<Device>(new SimFalcon(FalconModel(), hand_model(options.hand), hand));
}

/// The scene of the catalogue that they name; null for the clay.
std::unique_ptr<ForceScene> scene_of(const RigOptions& options) {
  if (options.scene == "clay") return nullptr;
  const SceneEntry& entry = *find_scene(options.scene);
  SceneValues values(entry.parameters);
  const bool is_set = values.set_all(options.scene_settings).ok();
  assert(is_set);
  static_cast<void>(is_set);
  return entry.make(values);
}

/// In the frame of the scene, which is as large as the hand's but for the placement's scale.
GuidanceOptions guidance_options(const RigOptions& options) {
  GuidanceOptions guidance = options.guidance;
  guidance.scale = options.placement.scale;
  return guidance;
}

}  // namespace

/// What exists from a start to its stop. Members use those before them.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): in the order of use, not of size
struct HapticRig::Run {
  Run(const RigOptions& options, std::unique_ptr<Recording> recording,
      std::unique_ptr<Device> opened, HapticRig& rig)
      : replayed(std::move(recording)),
        device(std::move(opened)),
        report_scene(scene_of(options)),
        guided(matter(options, rig), guidance_options(options)),
        placed(guided, options.placement),
        servo(*device, placed, servo_options(options)),
        watch(placed, rig.ring_, &guided) {
    assert(device && (report_scene != nullptr) != clay.has_value());
  }

  ForceScene& matter(const RigOptions& options, HapticRig& rig) {
    if (report_scene && options.has_vibro) return vibro.emplace(*report_scene);
    if (report_scene) return *report_scene;
    return clay.emplace(clay_options(options, rig.samples_), rig.ring_, rig.channel_);
  }

  /// The device when it is a real Falcon, or null.
  FalconDevice* falcon() const noexcept { return dynamic_cast<FalconDevice*>(device.get()); }

  std::unique_ptr<Recording> replayed;  ///< of a ReplayDevice
  std::unique_ptr<Device> device;
  std::unique_ptr<ForceScene> report_scene;  ///< either this one, perhaps in ...
  std::optional<VibroScene> vibro;
  std::optional<ClayScene> clay;  ///< ... or this
  GuidedScene guided;
  PlacedScene placed;
  Servo servo;
  RigWatch watch;
  std::optional<ServoThread> thread;
};

HapticRig::HapticRig() : ring_(kRingSamples) {}

HapticRig::~HapticRig() {
  // An error of the recording is for whoever calls stop; here it cannot be told.
  static_cast<void>(stop());
}

Result<void> HapticRig::start(const RigOptions& options) {
  if (auto good = check_rig(options); !good) return good;
  auto replayed = std::make_unique<Recording>();
  if (options.device == RigDevice::replay) {
    auto read = read_recording(options.replay_file);
    if (!read) return read.error();
    *replayed = std::move(read).value();
  }
  if (auto stopped = stop(); !stopped) return stopped;
  snapshot_ = {};
  snapshot_.placement = options.placement;
  points_.clear();
  hand_.begin_at(options.start_mm);
  auto device = make_device(options, hand_, *replayed);
  if (!device) return device.error();
  run_ = std::make_unique<Run>(options, std::move(replayed), std::move(device).value(), *this);
  if (is_halted_) run_->servo.halt();
  try {
    run_->thread.emplace(run_->servo, &run_->watch);
  } catch (const std::system_error& error) {
    run_.reset();
    return Error{ErrorKind::internal,
                 std::string("the servo got no thread (") + error.what() + "); end other programs"};
  }
  options_ = options;
  priority_refusal_ = run_->thread->priority_refusal();
  if (const FalconDevice* falcon = run_->falcon(); falcon != nullptr && priority_refusal_.empty()) {
    priority_refusal_ = falcon->priority_refusal();
  }
  return {};
}

Result<void> HapticRig::stop() {
  if (!run_) return {};
  assert(run_->thread);
  run_->thread->stop();
  look();
  snapshot_.tick.force_n = {};  // what the servo gave when it ended
  snapshot_.tick.faults |= kStopping;
  if (run_->clay) {
    run_->clay->end_stroke();
    samples_ = run_->clay->samples();
  }
  run_.reset();
  return stop_recording();
}

void HapticRig::halt() noexcept {
  is_halted_ = true;
  if (run_) run_->servo.halt();
}

void HapticRig::resume() noexcept {
  is_halted_ = false;
  if (run_) run_->servo.resume();
}

void HapticRig::set_clutched(bool clutched) noexcept {
  if (run_) run_->placed.set_clutched(clutched);
}

Result<void> HapticRig::start_recording(const std::filesystem::path& file,
                                        const std::string& note) {
  if (!run_) return Error{ErrorKind::bad_input, "nothing runs to be recorded; start a device"};
  if (recorder_) return Error{ErrorKind::bad_input, "a recording is being made; end it first"};
  auto started = Recorder::start(file, note);
  if (!started) return started.error();
  recorder_ = std::move(started).value();
  run_->watch.record(&recorder_->ring());
  return {};
}

Result<void> HapticRig::stop_recording() {
  if (!recorder_) return {};
  if (run_) run_->watch.stop_recording();
  const std::unique_ptr<Recorder> ended = std::move(recorder_);
  return ended->finish();
}

const RigSnapshot& HapticRig::look() {
  if (!run_) return snapshot_;
  if (run_->watch.snapshots().fetch()) snapshot_ = run_->watch.snapshots().read_slot();
  for (RigPoint point; run_->watch.points().pop(point);) points_.push_back(point);
  while (!points_.empty() && points_.front().time_s < points_.back().time_s - kPlottedS) {
    points_.pop_front();
  }
  return snapshot_;
}

const FalconStatus* HapticRig::falcon() {
  FalconDevice* falcon = run_ ? run_->falcon() : nullptr;
  return falcon != nullptr ? &falcon->look() : nullptr;
}

void HapticRig::home_falcon() {
  if (FalconDevice* falcon = run_ ? run_->falcon() : nullptr) falcon->home();
}

bool HapticRig::is_replay_over() const noexcept {
  return run_ && options_.device == RigDevice::replay &&
         snapshot_.tick.number >= run_->replayed->ticks.size();
}

}  // namespace argil::haptics
