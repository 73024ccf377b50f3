// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/surface_texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// How much of the detail counts at a node: all but near the edges, nothing on them.
double share_at(double x, double y) noexcept {
  constexpr double kFadeNodes = 3.0;
  constexpr double kLast = SurfaceDetail::kSide - 1;
  const double to_edge = std::min({x, y, kLast - x, kLast - y});
  return std::clamp(to_edge / kFadeNodes, 0.0, 1.0);
}

/// The height under a place, faded towards the edges of the patch; 0 beyond them.
double patch_height_mm(const SurfaceDetail& detail, const Vec3& place) noexcept {
  const double square = dot(detail.step_x_mm, detail.step_x_mm);
  assert(square > 0.0);
  const Vec3 from = place - detail.origin_mm;
  const double x = dot(from, detail.step_x_mm) / square;
  const double y = dot(from, detail.step_y_mm) / square;
  if (!(share_at(x, y) > 0.0)) return 0.0;
  const int i = std::min(static_cast<int>(x), SurfaceDetail::kSide - 2);
  const int j = std::min(static_cast<int>(y), SurfaceDetail::kSide - 2);
  const double s = x - i;
  const double t = y - j;
  const auto at = [&detail](int a, int b) { return static_cast<double>(detail.at(a, b)); };
  const double below = (1.0 - t) * at(i, j) + t * at(i, j + 1);
  const double above = (1.0 - t) * at(i + 1, j) + t * at(i + 1, j + 1);
  return share_at(x, y) * ((1.0 - s) * below + s * above);
}

/// How far a lag of this time constant goes in a tick.
double share_of(double passed_s, double constant_s) noexcept {
  return 1.0 - std::exp(-passed_s / constant_s);
}

}  // namespace

SurfaceTexture::SurfaceTexture(const TextureOptions& options) noexcept : options_(options) {
  assert(options.n_per_mm >= 0.0 && options.most_n >= 0.0 && options.play_mm >= 0.0);
  assert(options.slow_s > 0.0 && options.fast_s > 0.0);
}

void SurfaceTexture::tick(const SurfaceDetail& detail, const Vec3& place_mm, bool is_touching,
                          double passed_s) noexcept {
  assert(passed_s >= 0.0 && is_finite(place_mm));
  double height = 0.0;
  if (is_touching && detail.is_known) {
    if (!is_sliding_) dragged_mm_ = place_mm;
    // The dragged point follows on a leash as long as the play, along the surface only.
    const Vec3 moved = place_mm - dragged_mm_;
    const Vec3 along = moved - dot(moved, detail.normal) * detail.normal;
    const double slid = std::max(0.0, length(along) - options_.play_mm);
    dragged_mm_ = place_mm - along + slid * normalized(along);
    height = patch_height_mm(detail, dragged_mm_);
    // Where a contact begins is its mean: no step.
    if (!is_sliding_) slow_mm_ = height;
  }
  is_sliding_ = is_touching && detail.is_known;
  slow_mm_ += share_of(passed_s, options_.slow_s) * (height - slow_mm_);
  band_mm_ += share_of(passed_s, options_.fast_s) * (height - slow_mm_ - band_mm_);
  force_n_ = std::clamp(options_.n_per_mm * band_mm_, -options_.most_n, options_.most_n);
  most_force_n_ = std::max(most_force_n_, std::abs(force_n_));
}

Vec3 SurfaceTexture::added_to(const Vec3& push_n) const noexcept {
  const double push = length(push_n);
  return push_n + std::clamp(force_n_, -push, push) * normalized(push_n);
}

}  // namespace argil::haptics
