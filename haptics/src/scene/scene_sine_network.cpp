// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_sine_network.h"

#include <cassert>

#include "scene/contact.h"

namespace argil::haptics {

SineNetworkScene::SineNetworkScene(const SineNetworkOptions& options)
    : options_(options), network_(kMmPerM / options.frequency_per_m) {
  assert(options.stiffness_n_per_m >= 0.0 && options.damping_n_s_per_m >= 0.0);
}

SceneForce SineNetworkScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const SineNetwork::Answer found =
      network_.at(at.position_mm - Vec3{0.0, 0.0, options_.offset_mm});
  SceneForce felt;
  if (!(found.distance_mm < 0.0)) return felt;
  const SpringDamper law{options_.stiffness_n_per_m, options_.damping_n_s_per_m};
  const Vec3& away = found.gradient;
  felt.force_n = push_n(law, -found.distance_mm, dot(at.velocity_mm_per_s, away)) * away;
  felt.stiffness_n_per_m = law.stiffness_n_per_m * dot(away, away);
  return felt;
}

}  // namespace argil::haptics
