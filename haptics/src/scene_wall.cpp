// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene_wall.h"

#include <algorithm>
#include <cmath>

#include "contact.h"

namespace argil::haptics {
namespace {

constexpr Vec3 kUp{0.0, 1.0, 0.0};

}  // namespace

SceneForce WallScene::force_at(const HandleState& place) const noexcept {
  const double depth_mm = options_.offset_mm - place.position_mm.y;
  if (options_.kind == WallKind::linear) {  // eq. 3.7 counts the surface itself in
    if (depth_mm < 0.0) return {};
    return one_sided_contact(kUp, depth_mm, place.velocity_mm_per_s, options_.stiffness,
                             options_.damping, options_.is_one_sided);
  }
  SceneForce felt;
  if (options_.kind == WallKind::rigid) {
    if (depth_mm > 0.0) felt.force_n = options_.rigid_n * kUp;
    return felt;  // its stiffness is none that a number could tell
  }
  if (depth_mm < 0.0) return felt;
  const double depth_m = kMPerMm * depth_mm;
  const double speed_m_per_s = kMPerMm * place.velocity_mm_per_s.y;
  double push_n = options_.stiffness * std::pow(depth_m, options_.depth_exponent) -
                  options_.damping *
                      std::copysign(std::pow(std::abs(speed_m_per_s), options_.velocity_exponent),
                                    speed_m_per_s);
  if (options_.is_one_sided) push_n = std::max(push_n, 0.0);
  felt.force_n = push_n * kUp;
  felt.stiffness_n_per_m = options_.stiffness * options_.depth_exponent *
                           std::pow(depth_m, options_.depth_exponent - 1.0);
  return felt;
}

}  // namespace argil::haptics
