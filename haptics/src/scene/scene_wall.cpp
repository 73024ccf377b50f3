// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_wall.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/contact.h"

namespace argil::haptics {

WallScene::WallScene(const WallOptions& options) noexcept : options_(options) {
  options_.normal = normalized(options.normal);
  assert(options_.normal != Vec3{});
  assert(options.depth_exponent >= 1.0 && options.speed_exponent >= 1.0);
  assert(options.stiffness_n_per_m >= 0.0 && options.damping_n_s_per_m >= 0.0);
  assert(options.rigid_force_n > 0.0);
}

/// k d^n - c |v|^m sign(v), both in metres.
SceneForce WallScene::power_law(double depth_mm, double speed_mm_per_s) const noexcept {
  assert(depth_mm >= 0.0);
  const double n = options_.depth_exponent;
  const double depth = depth_mm / kMmPerM;
  const double speed = speed_mm_per_s / kMmPerM;
  const double slope = options_.power_stiffness_n_per_m_to_n * std::pow(depth, n - 1.0);
  const double drag = options_.power_damping_n_per_mps_to_m *
                      std::pow(std::abs(speed), options_.speed_exponent - 1.0);
  SceneForce felt;
  felt.force_n = (slope * depth - drag * speed) * options_.normal;
  felt.stiffness_n_per_m = n * slope;
  return felt;
}

SceneForce WallScene::force_at(const HandleState& handle) const noexcept {
  const HandleState at = bounded(handle);
  const double depth = options_.offset_mm - dot(options_.normal, at.position_mm);
  const double speed = dot(options_.normal, at.velocity_mm_per_s);
  SceneForce felt;
  if (!(depth >= 0.0)) {
    return felt;
  }
  switch (options_.kind) {
    case WallKind::rigid:
      if (depth > 0.0) {
        felt.force_n = options_.rigid_force_n * options_.normal;
        felt.stiffness_n_per_m = kRigidStiffnessNPerM;
      }
      return felt;
    case WallKind::linear:
      felt.force_n =
          ((options_.stiffness_n_per_m * depth - options_.damping_n_s_per_m * speed) / kMmPerM) *
          options_.normal;
      felt.stiffness_n_per_m = options_.stiffness_n_per_m;
      break;
    case WallKind::nonlinear:
      felt = power_law(depth, speed);
      break;
  }
  if (options_.one_sided && dot(felt.force_n, options_.normal) < 0.0) {
    felt.force_n = {};
  }
  return felt;
}

}  // namespace argil::haptics
