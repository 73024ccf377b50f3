// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "argil/core/vec3.h"

namespace argil::io {

/// Column-major, as in glTF: column c, row r is number 4 c + r.
using GltfMatrix = std::array<double, 16>;

inline GltfMatrix product(const GltfMatrix& a, const GltfMatrix& b) noexcept {
  GltfMatrix c{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return c;
}

inline Vec3 moved(const GltfMatrix& m, const Vec3& p) noexcept {
  const auto row = [&](std::size_t r) {
    return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r];
  };
  return {row(0), row(1), row(2)};
}

/// Of the upper left 3 x 3: negative where the matrix mirrors.
inline double determinant(const GltfMatrix& m) noexcept {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
         m[8] * (m[1] * m[6] - m[2] * m[5]);
}

/// From lengths of `unit_mm` with y up to mm with z up.
inline GltfMatrix to_mm_with_z_up(double unit_mm) noexcept {
  return {unit_mm, 0, 0, 0, 0, 0, unit_mm, 0, 0, -unit_mm, 0, 0, 0, 0, 0, 1};
}

}  // namespace argil::io
