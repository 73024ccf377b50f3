// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_spring.h"

#include <cassert>

#include "contact.h"

namespace argil::haptics {

SpringScene::SpringScene(const SpringOptions& options) noexcept : options_(options) {
  assert(options.stiffness_n_per_m >= 0.0 && options.damping_n_s_per_m >= 0.0);
}

SceneForce SpringScene::force_at(const HandleState& place) const noexcept {
  const HandleState at = bounded(place);
  SceneForce felt;
  felt.force_n = (options_.stiffness_n_per_m * (options_.center_mm - at.position_mm) -
                  options_.damping_n_s_per_m * at.velocity_mm_per_s) /
                 kMmPerM;
  felt.stiffness_n_per_m = options_.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
