// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_spring.h"

#include <cassert>

#include "scene/contact.h"

namespace argil::haptics {

SpringScene::SpringScene(const SpringOptions& options) noexcept : options_(options) {
  assert(options.stiffness_n_per_m >= 0.0 && options.damping_n_s_per_m >= 0.0);
  assert(is_finite(options.center_mm));
}

SceneForce SpringScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  SceneForce felt;
  felt.force_n = (options_.stiffness_n_per_m * (options_.center_mm - at.position_mm) -
                  options_.damping_n_s_per_m * at.velocity_mm_per_s) /
                 kMmPerM;
  felt.stiffness_n_per_m = options_.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
