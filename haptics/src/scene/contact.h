// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

#include "math/units.h"

namespace argil::haptics {

/// Where a scene stops believing a number: a thousand kilometres, or as much in a second. No square
/// or product of a scene overflows below it, so that every finite position gives a finite force.
constexpr double kFarthest = 1e9;

inline Vec3 bounded(const Vec3& a) noexcept {
  return {std::clamp(a.x, -kFarthest, kFarthest), std::clamp(a.y, -kFarthest, kFarthest),
          std::clamp(a.z, -kFarthest, kFarthest)};
}

inline HandleState bounded(const HandleState& handle) noexcept {
  HandleState b = handle;
  b.position_mm = bounded(handle.position_mm);
  b.velocity_mm_per_s = bounded(handle.velocity_mm_per_s);
  return b;
}

/// Spring and damper of what is touched; both >= 0.
struct SpringDamper {
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;
};

/// k depth - c speed, `speed` along the outward normal. Never negative: the damper of equations 3.7
/// to 3.28 would hold back a handle that leaves, which feels like glue.
inline double push_n(const SpringDamper& law, double depth_mm, double speed_mm_per_s) noexcept {
  assert(law.stiffness_n_per_m >= 0.0 && law.damping_n_s_per_m >= 0.0 && depth_mm >= 0.0);
  return std::max(
      0.0, (law.stiffness_n_per_m * depth_mm - law.damping_n_s_per_m * speed_mm_per_s) / kMmPerM);
}

/// The push of a surface along its unit normal, or no force for a zero normal; depth_mm > 0.
inline SceneForce contact(const SpringDamper& law, double depth_mm, const Vec3& normal,
                          const Vec3& velocity_mm_per_s) noexcept {
  SceneForce felt;
  felt.force_n = push_n(law, depth_mm, dot(velocity_mm_per_s, normal)) * normal;
  felt.stiffness_n_per_m = law.stiffness_n_per_m;
  return felt;
}

}  // namespace argil::haptics
