// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/adaptive_damping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "math/units.h"

namespace argil::haptics {
namespace {

/// Added damping below this is none: what is released has to end.
constexpr double kNoneNSPerM = 0.01;

/// Two counts that come and go are a swing, one is not. Just below, since a count's positions are
/// not exact sums.
RunningDecrementOptions swing_options(const DeviceTraits& traits) noexcept {
  RunningDecrementOptions options;
  constexpr double kCounts = 1.9;
  if (traits.quantum_mm > 0.0) options.least_swing_mm = kCounts * traits.quantum_mm;
  return options;
}

}  // namespace

double most_added_damping_n_s_per_m(const DampingOptions& options, const DeviceTraits& traits,
                                    double period_s, double velocity_lag_s) noexcept {
  assert(period_s > 0.0 && velocity_lag_s >= 0.0 && traits.mass_kg >= 0.0);
  const double late_s = period_s + traits.delay_s + velocity_lag_s;
  const double stable = options.share * 0.5 * std::numbers::pi * traits.mass_kg / late_s;
  if (traits.quantum_mm <= 0.0) return stable;
  // A count that comes and goes changes the mean of the velocities by two counts over T + lag.
  const double count_m_per_s = 2.0 * traits.quantum_mm / kMmPerM / (period_s + velocity_lag_s);
  return std::min(stable, options.most_count_n / count_m_per_s);
}

AdaptiveDamping::AdaptiveDamping(const DampingOptions& options, const DeviceTraits& traits) noexcept
    : options_(options), mass_kg_(traits.mass_kg), swing_(swing_options(traits)) {
  assert(options.damping_ratio > 0.0 && options.damping_ratio < 1.0);
  assert(options.share > 0.0 && options.share <= 1.0 && options.most_count_n > 0.0);
  assert(options.release_s > 0.0 && traits.mass_kg >= 0.0);
}

/// The handle's way along the contact, as long as there is one: through a spring's middle, where
/// the force turns round, the axis stays what it was.
void AdaptiveDamping::follow(const Vec3& direction, const Vec3& moved_mm,
                             double period_s) noexcept {
  if (direction != Vec3{}) {
    axis_ = dot(direction, axis_) < 0.0 ? -1.0 * direction : direction;
    apart_s_ = 0.0;
  } else {
    apart_s_ += period_s;
  }
  along_mm_ += dot(moved_mm, axis_);
}

Vec3 AdaptiveDamping::tick(const Vec3& force_n, const Vec3& moved_mm, const Vec3& velocity_mm_per_s,
                           double period_s, double most_n_s_per_m) noexcept {
  assert(period_s > 0.0 && most_n_s_per_m >= 0.0 && is_finite(moved_mm));
  if (options_.kind == DampingKind::fixed || !is_finite(force_n)) return force_n;
  const double push_n = length(force_n);
  const Vec3 direction = push_n > 0.0 ? force_n / push_n : Vec3{};
  if (axis_ == Vec3{} && direction == Vec3{}) return force_n;
  follow(direction, moved_mm, period_s);
  // A handle that bounces is off the surface for half a period.
  if (apart_s_ > swing_.slowest_stroke_s()) {
    reset();
    return force_n;
  }
  if (swing_.add(along_mm_, period_s)) {
    added_n_s_per_m_ += 2.0 * mass_kg_ * swing_.omega_rad_per_s() *
                        (options_.damping_ratio - swing_.damping_ratio());
  } else if (swing_.since_turn_s() > swing_.slowest_stroke_s()) {
    added_n_s_per_m_ *= std::exp(-period_s / options_.release_s);
    if (added_n_s_per_m_ < kNoneNSPerM) added_n_s_per_m_ = 0.0;
  }
  added_n_s_per_m_ = std::clamp(added_n_s_per_m_, 0.0, most_n_s_per_m);
  if (added_n_s_per_m_ <= 0.0 || push_n <= 0.0) return force_n;
  const double drag_n = added_n_s_per_m_ / kMmPerM * dot(velocity_mm_per_s, direction);
  return std::max(0.0, push_n - drag_n) * direction;
}

void AdaptiveDamping::reset() noexcept {
  swing_.reset();
  axis_ = {};
  along_mm_ = 0.0;
  apart_s_ = 0.0;
  added_n_s_per_m_ = 0.0;
}

}  // namespace argil::haptics
