// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_vibro.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argil::haptics {

void VibroScene::begin_tick(const HandleState& handle) noexcept {
  scene_.begin_tick(handle);
  const SceneForce felt = scene_.force_at(handle);
  const Vec3 normal = normalized(felt.force_n);
  const bool touches = dot(normal, normal) > 0.0;
  if (touches && has_last_) {
    const Vec3 moved = handle.position_mm - last_mm_;
    slid_mm_ += length(moved - dot(moved, normal) * normal);
  }
  last_mm_ = handle.position_mm;
  has_last_ = touches;
}

SceneForce VibroScene::force_at(const HandleState& place) const noexcept {
  SceneForce felt = scene_.force_at(place);
  const double push_n = length(felt.force_n);
  if (!(push_n > 0.0)) return felt;
  const double phase = 2.0 * std::numbers::pi * slid_mm_ / options_.wavelength_mm;
  felt.force_n *= 1.0 + options_.amplitude_n * std::min(push_n, 1.0) / push_n * std::sin(phase);
  return felt;
}

}  // namespace argil::haptics
