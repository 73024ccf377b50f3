// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_slider.h"

#include <cmath>
#include <numbers>

#include "contact.h"

namespace argil::haptics {
namespace {

double turns(double frequency_per_m, double y_mm) noexcept {
  return 2.0 * std::numbers::pi * frequency_per_m * kMPerMm * y_mm;
}

}  // namespace

double SliderScene::height_mm(double y_mm) const noexcept {
  return options_.amplitude_mm * std::sin(turns(options_.frequency_per_m, y_mm)) +
         options_.offset_mm;
}

double SliderScene::slope(double y_mm) const noexcept {
  return turns(options_.frequency_per_m, 1.0) * options_.amplitude_mm *
         std::cos(turns(options_.frequency_per_m, y_mm));
}

Vec3 SliderScene::normal(double y_mm) const noexcept {
  return normalized(Vec3{0.0, -slope(y_mm), 1.0});
}

SceneForce SliderScene::force_at(const HandleState& place) const noexcept {
  const Vec3& p = place.position_mm;
  const double depth_mm = height_mm(p.y) - p.z;
  if (!(depth_mm > 0.0)) return {};
  const Vec3 n = normal(p.y);
  return one_sided_contact(n, depth_mm * n.z, place.velocity_mm_per_s, options_.stiffness_n_per_m,
                           options_.damping_n_s_per_m);
}

SceneForce ClickScene::force_at(const HandleState& place) const noexcept {
  SceneForce felt = slider_.force_at(place);
  const SceneForce ball = ball_.force_at(place);
  felt.force_n += ball.force_n;
  felt.stiffness_n_per_m += ball.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
