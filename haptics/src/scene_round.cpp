// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_round.h"

#include <cmath>

#include "contact.h"

namespace argil::haptics {
namespace {

/// Pushed out of a radius; `from_middle` has no component that does not count.
SceneForce radial_force(const Vec3& from_middle, double radius_mm, const Vec3& velocity,
                        double stiffness_n_per_m, double damping_n_s_per_m) noexcept {
  const double distance = length(from_middle);
  if (!(distance > 0.0) || distance >= radius_mm) return {};
  return one_sided_contact(from_middle / distance, radius_mm - distance, velocity,
                           stiffness_n_per_m, damping_n_s_per_m);
}

}  // namespace

SceneForce SphereScene::force_at(const HandleState& place) const noexcept {
  return radial_force(place.position_mm - options_.center_mm, options_.radius_mm,
                      place.velocity_mm_per_s, options_.stiffness_n_per_m,
                      options_.damping_n_s_per_m);
}

SceneForce CylinderScene::force_at(const HandleState& place) const noexcept {
  Vec3 from_axis = place.position_mm - options_.center_mm;
  if (std::abs(from_axis.z) > 0.5 * options_.height_mm) return {};
  from_axis.z = 0.0;
  return radial_force(from_axis, options_.radius_mm, place.velocity_mm_per_s,
                      options_.stiffness_n_per_m, options_.damping_n_s_per_m);
}

}  // namespace argil::haptics
