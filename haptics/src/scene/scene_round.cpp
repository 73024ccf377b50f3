// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_round.h"

#include <cassert>
#include <cmath>

#include "scene/contact.h"

namespace argil::haptics {

SphereScene::SphereScene(const SphereOptions& options) noexcept : options_(options) {
  assert(options.radius_mm > 0.0 && is_finite(options.center_mm));
}

SceneForce SphereScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const Vec3 out = at.position_mm - options_.center_mm;
  const double d = length(out);
  if (!(d < options_.radius_mm)) {
    return {};
  }
  return contact({options_.stiffness_n_per_m, options_.damping_n_s_per_m}, options_.radius_mm - d,
                 normalized(out), at.velocity_mm_per_s);
}

CylinderScene::CylinderScene(const CylinderOptions& options) noexcept : options_(options) {
  assert(options.radius_mm > 0.0 && options.height_mm > 0.0);
}

SceneForce CylinderScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  Vec3 out = at.position_mm - options_.center_mm;
  const bool between_ends = std::abs(out.z) <= 0.5 * options_.height_mm;
  out.z = 0.0;
  const double d = length(out);
  if (!between_ends || !(d < options_.radius_mm)) {
    return {};
  }
  return contact({options_.stiffness_n_per_m, options_.damping_n_s_per_m}, options_.radius_mm - d,
                 normalized(out), at.velocity_mm_per_s);
}

}  // namespace argil::haptics
