// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/servo.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// A gap longer than this, and than three ticks, is a jump: what happened meanwhile is not known.
constexpr double kMostGapS = 0.05;

std::uint32_t faults_of_scene(std::uint32_t scene) noexcept {
  std::uint32_t faults = kServoSound;
  if ((scene & kSceneWindowStale) != 0) faults |= kWindowStale;
  if ((scene & kSceneOutsideWindow) != 0) faults |= kOutsideWindow;
  if ((scene & kSceneClayStopped) != 0) faults |= kClayStopped;
  if ((scene & kSceneWaiting) != 0) faults |= kWaiting;
  if ((scene & kSceneClutched) != 0) faults |= kClutched;
  if ((scene & kSceneStopped) != 0) faults |= kSimulatorStop;
  if ((scene & kSceneNotFinite) != 0) faults |= kForceNotFinite;
  return faults;
}

}  // namespace

Servo::Servo(Device& device, ForceScene& scene, const ServoOptions& options,
             ServoTickRing* recording) noexcept
    : device_(device),
      scene_(scene),
      options_(options),
      recording_(recording),
      coupling_(options.coupling),
      governor_(options.governor),
      damping_(options.damping, device.traits(options.period_s)),
      passivity_(options.passivity, delay_ticks(device.traits(options.period_s), options.period_s)),
      gate_(options.safety),
      velocity_(options.velocity_lag_s) {
  assert(options.period_s > 0.0 && std::isfinite(options.period_s));
  if (!options.position_filter) return;
  filter_.emplace(*options.position_filter);
  filter_lag_s_ = filter_lag_s(*options.position_filter, options.period_s);
}

/// The time since the last tick; the nominal period where that means nothing.
double Servo::elapsed(double now_s, std::uint32_t& faults) noexcept {
  const double elapsed_s = number_ > 0 ? now_s - last_s_ : options_.period_s;
  last_s_ = now_s;
  if (elapsed_s > 0.0 && elapsed_s <= std::max(kMostGapS, 3.0 * options_.period_s)) {
    return elapsed_s;
  }
  faults |= kClockJumped;
  return options_.period_s;
}

/// After a jump or a loss the motion and the velocity since the last position mean nothing.
void Servo::forget_motion() noexcept {
  velocity_.reset();
  coupling_.reset();
  damping_.reset();
  passivity_.reset();
  if (filter_) filter_->reset();
  scene_.forget_motion();
  has_position_ = false;
}

/// From a position to the force that is wanted.
void Servo::feel(const DeviceReading& reading, double elapsed_s, ServoTick& tick) noexcept {
  assert(elapsed_s > 0.0 && is_finite(reading.position_mm));
  HandleState handle;
  handle.position_mm =
      filter_ ? filter_->filter(reading.position_mm, elapsed_s) : reading.position_mm;
  tick.felt_mm = handle.position_mm;
  handle.velocity_mm_per_s = velocity_.velocity(reading.position_mm, elapsed_s);
  handle.time_s = tick.time_s;
  handle.is_active = (reading.buttons & 1U) != 0;
  scene_.begin_tick(handle);
  DeviceTraits traits = device_.traits(options_.period_s);
  // The force is held so late whatever filters the position.
  AidTick aid{elapsed_s, given_part_, reading.position_mm, delay_ticks(traits, options_.period_s)};
  traits.delay_s += filter_lag_s_;
  tick.most_stiffness_n_per_m =
      governor_.tick(elapsed_s, traits, options_.period_s, options_.coupling.damping_n_s_per_m,
                     scene_.window_stamp().lateness_s);
  const CoupledForce coupled =
      coupling_.tick(scene_, handle, tick.most_stiffness_n_per_m, elapsed_s);
  tick.faults |= faults_of_scene(coupled.faults);
  tick.velocity_mm_per_s = handle.velocity_mm_per_s;
  tick.proxy_mm = coupled.proxy_mm;
  handle.position_mm = coupled.proxy_mm;
  aid.most_stiffness_n_per_m = governor_.aid_stiffness_n_per_m(traits, options_.period_s);
  tick.aid_n = scene_.aid_n(handle, aid);
  if (!is_finite(tick.aid_n)) tick.faults |= kForceNotFinite;
  scene_.end_tick(handle);
  tick.window = scene_.window_stamp();
  const Vec3 moved_mm = has_position_ ? reading.position_mm - last_position_mm_ : Vec3{};
  last_position_mm_ = reading.position_mm;
  has_position_ = true;
  const double most_n_s_per_m = most_added_damping_n_s_per_m(
      options_.damping, traits, governor_.period_s(), options_.velocity_lag_s);
  const Vec3 damped_n =
      damping_.tick(coupled.force_n, moved_mm, handle.velocity_mm_per_s, elapsed_s, most_n_s_per_m);
  tick.added_damping_n_s_per_m = damping_.added_n_s_per_m();
  // Not even the sign of a zero is to differ where there is no aid: a replay compares bits.
  const bool has_aid = tick.aid_n != Vec3{};
  const Vec3 force_n = has_aid ? damped_n + tick.aid_n : damped_n;
  tick.wanted_n = passivity_.tick(force_n, moved_mm, elapsed_s);
}

/// How much of the force that was wanted the device is given; in its direction.
double Servo::given_part(const ServoTick& tick) const noexcept {
  if ((tick.faults & kCutFaults) != 0) return 0.0;
  const double square = dot(tick.wanted_n, tick.wanted_n);
  if (!(square > 0.0)) return gate_.gain();
  return std::clamp(dot(tick.force_n, tick.wanted_n) / square, 0.0, 1.0);
}

ServoTick Servo::tick(double now_s) noexcept {
  ServoTick tick;
  tick.time_s = now_s;
  const double elapsed_s = elapsed(now_s, tick.faults);
  tick.number = ++number_;
  const DeviceReading reading = device_.read(now_s);
  tick.is_ready = reading.is_ready && is_finite(reading.position_mm);
  if (!tick.is_ready) tick.faults |= kDeviceLost;
  if (is_halted_.load(std::memory_order_relaxed)) tick.faults |= kHalted;
  if (tick.faults != kServoSound) forget_motion();  // before feel: none of it may enter a stroke
  if (tick.is_ready) {
    tick.position_mm = reading.position_mm;
    tick.buttons = reading.buttons;
    feel(reading, elapsed_s, tick);
  }
  // The gate runs in every tick, also without a reading: it has to ramp, and to know what was
  // given.
  tick.force_n = gate_.limit(tick.wanted_n, tick.faults, elapsed_s);
  assert(is_finite(tick.force_n));
  if ((tick.faults & kCutFaults) != 0) {
    device_.cut();
  } else {
    device_.write(tick.force_n);
  }
  passivity_.gave(tick.force_n);
  given_part_ = given_part(tick);
  tick.given_part = given_part_;
  if ((tick.faults & kForceNotFinite) != 0) forget_motion();
  faults_seen_ |= tick.faults;
  if (recording_ != nullptr) recording_->push(tick);
  return tick;
}

void Servo::stop() noexcept {
  std::uint32_t faults = kStopping;
  gate_.limit({}, faults, 0.0);
  device_.cut();
  forget_motion();
}

}  // namespace argil::haptics
