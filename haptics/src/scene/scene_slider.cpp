// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_slider.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "scene/contact.h"

namespace argil::haptics {

SliderScene::SliderScene(const SliderOptions& options) noexcept
    : options_(options), wave_per_mm_(2.0 * std::numbers::pi * options.frequency_per_m / kMmPerM) {
  assert(options.amplitude_mm >= 0.0 && options.stiffness_n_per_m >= 0.0 &&
         options.damping_n_s_per_m >= 0.0);
}

double SliderScene::height_mm(double y_mm) const noexcept {
  return options_.offset_mm + options_.amplitude_mm * std::sin(wave_per_mm_ * y_mm);
}

Vec3 SliderScene::normal_at(double y_mm) const noexcept {
  const double slope = options_.amplitude_mm * wave_per_mm_ * std::cos(wave_per_mm_ * y_mm);
  return normalized(Vec3{0.0, -slope, 1.0});
}

SceneForce SliderScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const double depth = height_mm(at.position_mm.y) - at.position_mm.z;
  if (!(depth > 0.0)) {
    return {};
  }
  const Vec3 normal = normal_at(at.position_mm.y);
  return contact({options_.stiffness_n_per_m, options_.damping_n_s_per_m}, depth * normal.z, normal,
                 at.velocity_mm_per_s);
}

ClickScene::ClickScene(const ClickOptions& options) noexcept
    : slider_(options.slider), sphere_(options.sphere) {}

SceneForce ClickScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt = slider_.force_at(handle);
  const SceneForce click = sphere_.force_at(handle);
  felt.force_n += click.force_n;
  felt.stiffness_n_per_m += click.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
