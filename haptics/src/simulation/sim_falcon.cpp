// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/sim_falcon.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "math/unit_random.h"
#include "math/units.h"

namespace argil::haptics {
namespace {

/// Longest step of the integration.
constexpr double kStepS = 1e-4;
/// After a longer pause of the servo the handle has moved for this much time only.
constexpr double kMostMoveS = 0.1;

/// The nearest of offset + n quantum.
double rounded(double value, double quantum, double offset) noexcept {
  assert(quantum > 0.0);
  return std::round((value - offset) / quantum) * quantum + offset;
}

}  // namespace

DeviceTraits traits_of(const FalconModel& model, double period_s) noexcept {
  assert(period_s > 0.0 && model.delay_ticks >= 0);
  return {model.mass_kg, model.damping_n_s_per_m, model.most_force_n, model.delay_ticks * period_s,
          model.quantum_mm};
}

FalconModel frictionless_falcon() noexcept {
  FalconModel model;
  model.damping_n_s_per_m = 3.975;
  model.friction_n = 0.0;
  return model;
}

/// A hand that pushes has nothing along its direction while it presses; else it guides all round.
SimFalcon::Grip SimFalcon::grip_of(const HandIntent& intent) const noexcept {
  if (!intent.holds) return {};
  Grip grip{hand_.damping_n_s_per_m, hand_.stiffness_n_per_m, hand_.damping_n_s_per_m,
            hand_.stiffness_n_per_m};
  if (hand_.is_push && intent.press_n > 0.0) grip.along_damping = grip.along_stiffness = 0.0;
  return grip;
}

/// The hand's force without the part that grows with the handle's own velocity.
Vec3 SimFalcon::hand_force(const HandIntent& intent, const Grip& grip) const noexcept {
  if (!intent.holds || hand_.stiffness_n_per_m <= 0.0) return {};
  const Vec3 off_mm = intent.place_mm - position_mm_;
  const Vec3 along = dot(off_mm, intent.direction) * intent.direction;
  const Vec3& v = intent.velocity_mm_per_s;
  const Vec3 v_along = dot(v, intent.direction) * intent.direction;
  return (grip.stiffness * (off_mm - along) + grip.along_stiffness * along +
          grip.damping * (v - v_along) + grip.along_damping * v_along) /
             kMmPerM +
         intent.press_n * intent.direction;
}

SimFalcon::SimFalcon(const FalconModel& model, const HandModel& hand, HandPlan plan)
    : SimFalcon(model, hand, std::make_unique<HandPlan>(std::move(plan))) {}

SimFalcon::SimFalcon(const FalconModel& model, const HandModel& hand,
                     std::unique_ptr<HandSource> plan)
    : SimFalcon(model, hand, *plan) {
  plan_ = std::move(plan);
}

SimFalcon::SimFalcon(const FalconModel& model, const HandModel& hand, HandSource& source)
    : model_(model),
      hand_(hand),
      source_(source),
      kinematics_(martin_hillier_geometry()),
      random_(model.seed) {
  assert(model.mass_kg > 0.0 && model.most_force_n > 0.0 && model.quantum_mm > 0.0);
  assert(model.delay_ticks >= 0 && model.delay_ticks <= kMostDelayTicks);
  assert(model.damping_n_s_per_m >= 0.0 && model.friction_n >= 0.0 && !model.reach_mm.empty());
  position_mm_ = source_.start_mm();
  measured_mm_ = position_mm_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    zero_offset_mm_[axis] = (unit_random(random_) - 0.5) * model_.quantum_mm;
  }
}

/// The velocity after half a step: force and damping together, exactly; then friction, which takes
/// its impulse but never more than there is, so that a handle that friction can hold stays where it
/// is.
void SimFalcon::kick(const HandIntent& intent, const Grip& grip, double dt_s) noexcept {
  const double mass = model_.mass_kg + (intent.holds ? hand_.mass_kg : 0.0);
  assert(mass > 0.0 && dt_s > 0.0);
  const Vec3 push = kMmPerM / mass * (held_n_ + hand_force(intent, grip));
  const auto damped = [&](const Vec3& velocity, const Vec3& rise, double damping) {
    const double rate = (model_.damping_n_s_per_m + damping) / mass;
    const double kept = std::exp(-rate * dt_s);
    return kept * velocity + (rate > 0.0 ? (1.0 - kept) / rate : dt_s) * rise;
  };
  const Vec3& axis = intent.direction;
  const Vec3 v_along = dot(velocity_mm_per_s_, axis) * axis;
  const Vec3 push_along = dot(push, axis) * axis;
  velocity_mm_per_s_ = damped(velocity_mm_per_s_ - v_along, push - push_along, grip.damping) +
                       damped(v_along, push_along, grip.along_damping);
  const double speed = length(velocity_mm_per_s_);
  const double lost = model_.friction_n * dt_s / mass * kMmPerM;
  velocity_mm_per_s_ *= speed > lost ? 1.0 - lost / speed : 0.0;
}

/// Kick, drift, kick: half a step's velocity, the position, the other half. Second order, and the
/// end stops take the velocity of the axis that they stop.
void SimFalcon::step(double time_s, double dt_s) noexcept {
  const HandIntent intent = source_.at(time_s + 0.5 * dt_s);
  const Grip grip = grip_of(intent);
  kick(intent, grip, 0.5 * dt_s);
  position_mm_ += dt_s * velocity_mm_per_s_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double stopped =
        std::clamp(position_mm_[axis], model_.reach_mm.min[axis], model_.reach_mm.max[axis]);
    if (stopped == position_mm_[axis]) continue;
    position_mm_[axis] = stopped;
    velocity_mm_per_s_[axis] = 0.0;
  }
  kick(intent, grip, 0.5 * dt_s);
}

/// Steps of equal length up to now; the first reading only starts the clock.
void SimFalcon::move_to(double now_s) noexcept {
  if (!has_time_) {
    time_s_ = now_s;
    has_time_ = true;
  }
  const double span_s = std::min(now_s - time_s_, kMostMoveS);
  if (span_s > 0.0) {
    const int steps = std::max(1, static_cast<int>(std::ceil(span_s / kStepS - 1e-9)));
    const double dt_s = span_s / steps;
    assert(dt_s <= (1.0 + 1e-6) * kStepS);
    for (int n = 0; n < steps; ++n) step(now_s - span_s + n * dt_s, dt_s);
  }
  time_s_ = now_s;
}

double SimFalcon::jitter() noexcept {
  if (model_.jitter_counts <= 0.0) return 0.0;
  return std::round((2.0 * unit_random(random_) - 1.0) * (model_.jitter_counts + 0.5));
}

/// What the host computes from whole counts of the three arms; the last reading where the arms
/// cannot reach (beyond the stops).
Vec3 SimFalcon::position_by_arms() noexcept {
  const auto angles = kinematics_.angles_of(position_mm_ + kFalconCenterMm);
  if (!angles) return measured_mm_;
  LegValues ticks = kinematics_.ticks_of_angles(*angles);
  for (std::size_t leg = 0; leg < ticks.size(); ++leg) {
    // Where in a count the arm was when the encoder started, as the position of its zero.
    const double offset = zero_offset_mm_[leg] / model_.quantum_mm;
    ticks[leg] = rounded(ticks[leg], 1.0, offset) + jitter();
  }
  const auto found =
      kinematics_.position_of(kinematics_.angles_of_ticks(ticks), measured_mm_ + kFalconCenterMm);
  return found.is_converged ? found.position_mm - kFalconCenterMm : measured_mm_;
}

/// The position as the encoders give it.
Vec3 SimFalcon::measured_position() noexcept {
  if (model_.encoder == Encoder::exact) return position_mm_;
  if (model_.encoder == Encoder::kinematic) return position_by_arms();
  Vec3 read_mm = position_mm_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    read_mm[axis] = rounded(read_mm[axis], model_.quantum_mm, zero_offset_mm_[axis]) +
                    jitter() * model_.quantum_mm;
  }
  return read_mm;
}

DeviceReading SimFalcon::read(double now_s) noexcept {
  move_to(now_s);
  DeviceReading reading;
  reading.is_ready = is_plugged_;
  if (!is_plugged_) return reading;
  measured_mm_ = measured_position();
  reading.position_mm = measured_mm_;
  reading.buttons = source_.at(now_s).is_active ? 1U : 0U;
  return reading;
}

void SimFalcon::write(const Vec3& force_n) noexcept {
  for (std::size_t n = pending_n_.size() - 1; n > 0; --n) pending_n_[n] = pending_n_[n - 1];
  pending_n_[0] = is_plugged_ && is_finite(force_n) ? force_n : Vec3{};
  held_n_ = is_plugged_ ? pending_n_[static_cast<std::size_t>(model_.delay_ticks)] : Vec3{};
  const double size = length(held_n_);
  if (size > model_.most_force_n) held_n_ *= model_.most_force_n / size;
}

DeviceTraits SimFalcon::traits(double period_s) const noexcept {
  return traits_of(model_, period_s);
}

}  // namespace argil::haptics
