// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_spring.h"

#include <algorithm>

#include "contact.h"

namespace argil::haptics {

SceneForce SpringScene::force_at(const HandleState& place) const noexcept {
  SceneForce felt;
  felt.force_n = -kMPerMm * (options_.stiffness_n_per_m * (place.position_mm - options_.center_mm) +
                             options_.damping_n_s_per_m * place.velocity_mm_per_s);
  felt.stiffness_n_per_m = options_.stiffness_n_per_m;
  return felt;
}

SceneForce WorkspaceScene::force_at(const HandleState& place) const noexcept {
  SceneForce felt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double inside =
        std::clamp(place.position_mm[axis], options_.min_mm[axis], options_.max_mm[axis]);
    felt.force_n[axis] = kMPerMm * options_.stiffness_n_per_m * (inside - place.position_mm[axis]);
    if (inside != place.position_mm[axis]) felt.stiffness_n_per_m = options_.stiffness_n_per_m;
  }
  return felt;
}

}  // namespace argil::haptics
