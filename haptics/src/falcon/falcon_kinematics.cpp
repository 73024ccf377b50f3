// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/falcon/falcon_kinematics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "math/mat3.h"
#include "math/units.h"

namespace argil::haptics {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// Longest step of Newton's method.
constexpr double kLongestStepMm = 20.0;

/// One step may go this fraction of the path to where a rod lies square to its leg's plane, beyond
/// which the loop has no real solution.
constexpr double kFractionOfRoom = 0.8;

/// A Newton step this small leaves an error far below it: the method squares it.
constexpr double kLastStepMm = 1e-9;

constexpr LegValues kLegDeg{105.0, -15.0, -135.0};
constexpr double kCountsPerTurn = 320.0 * 4.0;

/// x with sum of x[i] row[i] = b.
LegValues solve_transposed(const std::array<Vec3, 3>& row, const Vec3& b) noexcept {
  const double scale = 1.0 / determinant(Mat3{row});
  return {scale * dot(b, cross(row[1], row[2])), scale * dot(b, cross(row[2], row[0])),
          scale * dot(b, cross(row[0], row[1]))};
}

}  // namespace

FalconGeometry libnifalcon_geometry() noexcept {
  FalconGeometry g;
  g.arm_mm = 60.0;
  g.rod_mm = 102.5;
  g.stub_mm = 11.25;
  g.hinge_radial_mm = 40.0;
  g.joint_radial_mm = 14.43;
  g.hinge_tangential_mm = -23.09;
  g.joint_tangential_mm = -25.0;
  g.leg_deg = kLegDeg;
  g.counts_per_turn = kCountsPerTurn;
  g.gear_ratio = 110.0 / 14.25;  // radius of the arm's sector over that of the motor's drum
  g.tick_zero_deg = 35.0;
  g.words_per_nm = 10000.0;
  return g;
}

FalconGeometry martin_hillier_geometry() noexcept {
  FalconGeometry g;
  g.arm_mm = 60.0;
  g.rod_mm = 102.5;
  g.stub_mm = 11.5;
  g.hinge_radial_mm = 36.6;
  g.joint_radial_mm = 15.7;
  g.hinge_tangential_mm = -27.2;  // the paper's tangential offsets have the opposite sign
  g.joint_tangential_mm = -26.2;
  g.leg_deg = kLegDeg;
  g.counts_per_turn = kCountsPerTurn;
  g.gear_ratio = 7.62;
  g.tick_zero_deg = 40.0;
  constexpr double kMotorNmPerWord = 1.9835e-5;  // at rest
  g.words_per_nm = 1.0 / (g.gear_ratio * kMotorNmPerWord);
  return g;
}

FalconKinematics::FalconKinematics(const FalconGeometry& geometry) noexcept
    : arm_mm_(geometry.arm_mm),
      rod_mm_(geometry.rod_mm),
      stubs_mm_(2.0 * geometry.stub_mm),
      radial_mm_(geometry.hinge_radial_mm - geometry.joint_radial_mm),
      across_mm_(geometry.joint_tangential_mm - geometry.hinge_tangential_mm),
      rad_per_tick_(2.0 * std::numbers::pi / (geometry.counts_per_turn * geometry.gear_ratio)),
      rad_at_zero_(geometry.tick_zero_deg * kRadPerDeg),
      words_per_nm_(geometry.words_per_nm) {
  assert(arm_mm_ > 0.0 && rod_mm_ > 0.0 && stubs_mm_ >= 0.0);
  assert(geometry.counts_per_turn > 0.0 && geometry.gear_ratio > 0.0 && words_per_nm_ > 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double phi = geometry.leg_deg[i] * kRadPerDeg;
    leg_[i] = {{std::cos(phi), std::sin(phi), 0.0}, {-std::sin(phi), std::cos(phi), 0.0}};
  }
}

std::optional<FalconKinematics::Loop> FalconKinematics::loop_of(
    const Leg& leg, const Vec3& position_mm) const noexcept {
  Loop loop;
  loop.along = dot(position_mm, leg.out) - radial_mm_;
  loop.across = dot(position_mm, leg.across) + across_mm_;
  loop.up = position_mm.z;
  if (!(std::abs(loop.across) < rod_mm_)) return std::nullopt;
  loop.rod = std::sqrt(rod_mm_ * rod_mm_ - loop.across * loop.across);
  loop.length = stubs_mm_ + loop.rod;
  return loop;
}

/// The loop's error is F = p^2 + w^2 - L^2, (p, w) leading from the knee to the platform's joint in
/// the leg's plane. `pull` is dF/dP / 2 and `lever` -dF/dtheta / 2, so that theta' = pull . P' /
/// lever.
FalconKinematics::Closure FalconKinematics::closure_of(const Leg& leg, const Loop& loop,
                                                       const Arm& arm) const noexcept {
  const double p = loop.along - arm_mm_ * arm.cosine;
  const double w = loop.up - arm_mm_ * arm.sine;
  Closure closure;
  closure.pull = p * leg.out + (loop.length * loop.across / loop.rod) * leg.across;
  closure.pull.z += w;
  closure.error = p * p + w * w - loop.length * loop.length;
  closure.lever = arm_mm_ * (w * arm.cosine - p * arm.sine);
  return closure;
}

std::optional<FalconKinematics::Closures> FalconKinematics::closures_of(
    const Arms& arms, const Vec3& position_mm) const noexcept {
  Closures all;
  bool has_levers = true;
  double lengths = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Loop> loop = loop_of(leg_[i], position_mm);
    if (!loop) return std::nullopt;
    const Closure closure = closure_of(leg_[i], *loop, arms[i]);
    all.pull[i] = closure.pull;
    all.error[i] = closure.error;
    all.lever[i] = closure.lever;
    has_levers = has_levers && closure.lever > kLeastSine * arm_mm_ * loop->length;
    lengths *= length(closure.pull);
  }
  // The legs are numbered clockwise: negative where the platform is on the user's side of the
  // knees.
  all.is_regular = has_levers && -determinant(Mat3{all.pull}) > kLeastSine * lengths;
  return all;
}

/// Inverse kinematics: each arm's angle closes a triangle of arm, loop length and the line from the
/// hinge to the platform's joint, by the law of cosines.
std::optional<FalconKinematics::Arms> FalconKinematics::arms_at(
    const Vec3& position_mm) const noexcept {
  Arms arms;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Loop> loop = loop_of(leg_[i], position_mm);
    if (!loop) return std::nullopt;
    const double far = std::hypot(loop->along, loop->up);
    // Cosine of the angle between the arm and the line to the joint.
    const double q =
        (far * far + arm_mm_ * arm_mm_ - loop->length * loop->length) / (2.0 * arm_mm_ * far);
    if (!(std::abs(q) <= 1.0)) return std::nullopt;     // out of reach
    const double r = std::sqrt((1.0 - q) * (1.0 + q));  // its sine, with the elbow outward
    arms[i].cosine = (loop->along * q + loop->up * r) / far;
    arms[i].sine = (loop->up * q - loop->along * r) / far;
  }
  return arms;
}

std::optional<LegValues> FalconKinematics::angles_of(const Vec3& position_mm) const noexcept {
  const std::optional<Arms> arms = arms_at(position_mm);
  if (!arms) return std::nullopt;
  LegValues angles{};
  for (std::size_t i = 0; i < 3; ++i) angles[i] = std::atan2((*arms)[i].sine, (*arms)[i].cosine);
  return angles;
}

double FalconKinematics::allowed_share(const Vec3& position_mm, const Vec3& step) const noexcept {
  assert(length(step) > 0.0);
  double allowed = std::min(1.0, kLongestStepMm / length(step));
  for (const Leg& leg : leg_) {
    const double across = dot(position_mm, leg.across) + across_mm_;
    const double sideways = dot(step, leg.across);
    const double room = rod_mm_ - std::copysign(1.0, sideways) * across;
    allowed = std::min(allowed, kFractionOfRoom * room / std::abs(sideways));
  }
  return allowed;
}

FalconKinematics::Solution FalconKinematics::position_of(const LegValues& angles_rad,
                                                         const Vec3& start_mm) const noexcept {
  Arms arms;
  for (std::size_t i = 0; i < 3; ++i) arms[i] = {std::cos(angles_rad[i]), std::sin(angles_rad[i])};
  Solution found{start_mm, 0, false};
  std::optional<Closures> all = closures_of(arms, start_mm);
  if (!all) {
    found.position_mm = kFalconCenterMm;
    all = closures_of(arms, found.position_mm);
  }
  // F + 2 pull . step = 0 for all three legs.
  for (; all && found.steps < kMostSteps; all = closures_of(arms, found.position_mm)) {
    const LegValues& error = all->error;
    const Vec3 step = -0.5 * solve(Mat3{all->pull}, {error[0], error[1], error[2]});
    if (!is_finite(step)) return found;
    if (step != Vec3{}) found.position_mm += allowed_share(found.position_mm, step) * step;
    ++found.steps;
    if (length(step) <= kLastStepMm) {
      found.is_converged = all->is_regular;
      return found;
    }
  }
  return found;
}

LegValues FalconKinematics::angles_of_ticks(const LegValues& ticks) const noexcept {
  LegValues angles{};
  for (std::size_t i = 0; i < 3; ++i) angles[i] = ticks[i] * rad_per_tick_ + rad_at_zero_;
  return angles;
}

LegValues FalconKinematics::ticks_of_angles(const LegValues& angles_rad) const noexcept {
  LegValues ticks{};
  for (std::size_t i = 0; i < 3; ++i) ticks[i] = (angles_rad[i] - rad_at_zero_) / rad_per_tick_;
  return ticks;
}

std::optional<std::array<Vec3, 3>> FalconKinematics::rates_of(
    const Vec3& position_mm) const noexcept {
  const std::optional<Arms> arms = arms_at(position_mm);
  if (!arms) return std::nullopt;
  const std::optional<Closures> all = closures_of(*arms, position_mm);
  if (!all || !all->is_regular) return std::nullopt;
  std::array<Vec3, 3> rates;
  for (std::size_t i = 0; i < 3; ++i) rates[i] = all->pull[i] / all->lever[i];
  return rates;
}

FalconKinematics::MotorWords FalconKinematics::motor_words(const Vec3& force_n,
                                                           const Vec3& position_mm) const noexcept {
  MotorWords words;
  const std::optional<std::array<Vec3, 3>> rates = rates_of(position_mm);
  if (!rates) {
    words.is_singular = true;
    return words;
  }
  const LegValues torque_nmm = solve_transposed(*rates, force_n);
  LegValues wanted{};
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    wanted[i] = -words_per_nm_ / kMmPerM * torque_nmm[i];
    if (!std::isfinite(wanted[i])) return words;
    most = std::max(most, std::abs(wanted[i]));
  }
  if (most > kFalconLargestWord) words.scale = kFalconLargestWord / most;
  for (std::size_t i = 0; i < 3; ++i) {
    words.exact[i] = words.scale * wanted[i];
    const double word =
        std::clamp(std::round(words.exact[i]), -1.0 * kFalconLargestWord, 1.0 * kFalconLargestWord);
    words.word[i] = static_cast<std::int16_t>(word);
    assert(std::abs(words.word[i]) <= kFalconLargestWord);
  }
  return words;
}

}  // namespace argil::haptics
