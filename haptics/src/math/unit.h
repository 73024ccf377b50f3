// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// Whether the length is 1, within what rounding and checked options leave; for asserts.
inline bool is_unit(const Vec3& v) noexcept { return std::abs(dot(v, v) - 1.0) < 1e-5; }
inline bool is_unit(const Quat& q) noexcept {
  return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-5;
}

}  // namespace argil::haptics
