// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// A 3 x 3 matrix by rows.
struct Mat3 {
  std::array<Vec3, 3> row{};

  /// Adds scale * a b^T.
  constexpr void add_outer(double scale, const Vec3& a, const Vec3& b) noexcept {
    for (std::size_t i = 0; i < 3; ++i) row[i] += (scale * a[i]) * b;
  }
};

constexpr Vec3 operator*(const Mat3& m, const Vec3& v) noexcept {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}

constexpr double determinant(const Mat3& m) noexcept {
  return dot(m.row[0], cross(m.row[1], m.row[2]));
}

/// x with m x = b, for a determinant that is not zero (Cramer's rule).
constexpr Vec3 solve(const Mat3& m, const Vec3& b) noexcept {
  const Vec3 c0 = cross(m.row[1], m.row[2]);
  const Vec3 c1 = cross(m.row[2], m.row[0]);
  const Vec3 c2 = cross(m.row[0], m.row[1]);
  return (b.x * c0 + b.y * c1 + b.z * c2) / dot(m.row[0], c0);
}

}  // namespace argil::haptics
