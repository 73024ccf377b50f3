// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "argil/haptics/scene.h"

namespace argil::haptics {

inline constexpr double kMPerMm = 1e-3;

/// A spring and a damper along an outward unit normal, `depth_mm` > 0 under the surface. One-sided:
/// the damper may ease the push to nothing, never pull a handle that leaves back in.
inline SceneForce one_sided_contact(const Vec3& normal, double depth_mm, const Vec3& velocity,
                                    double stiffness_n_per_m, double damping_n_s_per_m,
                                    bool is_one_sided = true) noexcept {
  SceneForce felt;
  double push_n =
      kMPerMm * (stiffness_n_per_m * depth_mm - damping_n_s_per_m * dot(velocity, normal));
  if (is_one_sided) push_n = std::max(push_n, 0.0);
  felt.force_n = push_n * normal;
  felt.stiffness_n_per_m = stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
