// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/simulation/tracking_hand.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/unit_random.h"

namespace argil::haptics {
namespace {

/// Slower is a place meant wrongly, faster a tremor, which is smaller.
constexpr double kLeastHz = 0.15;
constexpr double kMostHz = 0.8;
/// A hand begins where it means to, and strays from there on.
constexpr double kStraysAfterS = 1.0;
/// No person reaches farther beside what is seen.
constexpr double kMostCorrectionMm = 20.0;
/// Forces change slowly while a hand presses and slides; what is sudden is faster than this.
constexpr double kUsualForceS = 0.25;

}  // namespace

TrackingHand::TrackingHand(std::vector<HandKey> plan, const TrackingHandOptions& options)
    : plan_(std::move(plan)), options_(options) {
  assert(options.reaction_s >= 0.0 && options.reaction_s <= kMostReactionS);
  assert(options.gain_per_s >= 0.0 && options.gain_per_s <= 5.0);
  assert(options.stray_mm >= 0.0 && options.notices_n >= 0.0);
  std::uint64_t random = options.seed;
  for (auto& axis : sines_) {
    for (Sine& sine : axis) {
      const double hz = kLeastHz + (kMostHz - kLeastHz) * unit_random(random);
      sine.rad_per_s = 2.0 * std::numbers::pi * hz;
      sine.phase = 2.0 * std::numbers::pi * unit_random(random);
    }
  }
}

Vec3 TrackingHand::strayed_mm(double time_s) const noexcept {
  Vec3 sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Sine& sine : sines_[axis]) {
      sum[axis] += std::sin(sine.rad_per_s * time_s + sine.phase);
    }
  }
  // The mean square of three sines is 3 / 2.
  const double size = options_.stray_mm / std::sqrt(1.5);
  return std::clamp(time_s / kStraysAfterS, 0.0, 1.0) * size * sum;
}

HandIntent TrackingHand::at(double time_s) noexcept {
  HandIntent intent = plan_.at(time_s);
  intent.place_mm += strayed_mm(time_s) + correction_mm_;
  if (has_felt_ && time_s >= felt_s_ + options_.reaction_s) intent.is_active = true;
  return intent;
}

/// What was seen a reaction time ago changes the correction for as long as it was seen.
void TrackingHand::correct(const ServoTick& tick, double elapsed_s) noexcept {
  const std::size_t size = error_mm_.size();
  const HandIntent meant = plan_.at(tick.time_s);
  Vec3 error_mm = meant.place_mm - tick.proxy_mm;
  // How deep it presses is what it feels, not what it sees.
  if (meant.press_n > 0.0) error_mm -= dot(error_mm, meant.direction) * meant.direction;
  error_mm_[seen_ % size] = error_mm;
  error_s_[seen_ % size] = tick.time_s;
  ++seen_;
  // A servo that is faster than 1 kHz would fill it before its time: the oldest is then answered.
  if (seen_ - looked_ > size) looked_ = seen_ - size;
  if (error_s_[looked_ % size] + options_.reaction_s > tick.time_s) return;
  while (looked_ + 1 < seen_ &&
         error_s_[(looked_ + 1) % size] + options_.reaction_s <= tick.time_s) {
    ++looked_;
  }
  correction_mm_ += options_.gain_per_s * elapsed_s * error_mm_[looked_ % size];
  const double far = length(correction_mm_);
  if (far > kMostCorrectionMm) correction_mm_ *= kMostCorrectionMm / far;
}

void TrackingHand::feel(const ServoTick& tick, double elapsed_s) noexcept {
  const Vec3 sudden_n = tick.force_n - usual_n_;
  const bool has_slid = tick.time_s > kStraysAfterS + kUsualForceS;
  if (!has_felt_ && has_slid && length(sudden_n) > options_.notices_n) {
    has_felt_ = true;
    felt_s_ = tick.time_s;
  }
  usual_n_ += elapsed_s / (kUsualForceS + elapsed_s) * sudden_n;
}

void TrackingHand::see(const ServoTick& tick) noexcept {
  if (!tick.is_ready) return;
  assert(is_finite(tick.proxy_mm) && is_finite(tick.force_n));
  const double elapsed_s = std::max(0.0, tick.time_s - last_s_);
  last_s_ = tick.time_s;
  if (options_.is_sighted) correct(tick, elapsed_s);
  if (options_.notices_n > 0.0) feel(tick, elapsed_s);
}

}  // namespace argil::haptics
