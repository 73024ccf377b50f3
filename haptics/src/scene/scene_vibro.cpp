// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_vibro.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "scene/contact.h"

namespace argil::haptics {

VibroScene::VibroScene(ForceScene& touched, const VibroOptions& options) noexcept
    : touched_(touched), options_(options) {
  assert(options.wavelength_mm > 0.0 && options.play_mm >= 0.0 && options.amplitude_n >= 0.0);
}

void VibroScene::begin_tick(const HandleState& handle) noexcept {
  touched_.begin_tick(handle);
  const Vec3 position = bounded(handle.position_mm);
  const Vec3 normal = normalized(touched_.force_at(handle).force_n);
  const bool was_in_contact = in_contact_;
  in_contact_ = normal != Vec3{};
  if (!in_contact_ || !was_in_contact) {
    dragged_mm_ = position;
    return;
  }
  // The dragged point follows on a leash as long as the play, along the surface only.
  const Vec3 moved = position - dragged_mm_;
  const Vec3 along = moved - dot(moved, normal) * normal;
  const double slid = std::max(0.0, length(along) - options_.play_mm);
  dragged_mm_ = position - along + slid * normalized(along);
  const double waves = phase_ + slid / options_.wavelength_mm;
  phase_ = waves - std::floor(waves);
  assert(phase_ >= 0.0 && phase_ <= 1.0);
}

void VibroScene::forget_motion() noexcept {
  in_contact_ = false;
  touched_.forget_motion();
}

SceneForce VibroScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt = touched_.force_at(handle);
  const double push = length(felt.force_n);
  const double amplitude = std::min(options_.amplitude_n, push);
  felt.force_n +=
      (amplitude * std::sin(2.0 * std::numbers::pi * phase_)) * normalized(felt.force_n);
  return felt;
}

int VibroScene::most_queries() const noexcept { return std::max(1, touched_.most_queries() - 1); }

}  // namespace argil::haptics
