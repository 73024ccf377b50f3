// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "argil/core/vec3.h"

namespace argil::io {

/// phi between the eight corners of a cell, 4 i + 2 j + k at (i, j, k), as differences along the
/// axes: c0 + x cx + y cy + z cz + xy cxy + ...; places are shares of the cell, 0 to 1.
struct Trilinear {
  double c0, cx, cy, cz, cxy, cxz, cyz, cxyz;

  explicit Trilinear(const std::array<float, 8>& corners) noexcept {
    const auto at = [&](std::size_t i) { return static_cast<double>(corners[i]); };
    c0 = at(0);
    cx = at(4) - c0;
    cy = at(2) - c0;
    cz = at(1) - c0;
    cxy = at(6) - at(4) - cy;
    cxz = at(5) - at(4) - cz;
    cyz = at(3) - at(2) - cz;
    cxyz = at(7) - at(6) - (at(5) - at(4)) - cyz;
  }
  double value(const Vec3& s) const noexcept {
    return c0 + s.z * cz + s.y * (cy + s.z * cyz) +
           s.x * (cx + s.z * cxz + s.y * (cxy + s.z * cxyz));
  }
  /// How far rounding may take a value.
  double rounding() const noexcept {
    return 1e-14 * (std::abs(c0) + std::abs(cx) + std::abs(cy) + std::abs(cz));
  }
  Vec3 slope(const Vec3& s) const noexcept {
    return {cx + s.y * cxy + s.z * (cxz + s.y * cxyz), cy + s.x * cxy + s.z * (cyz + s.x * cxyz),
            cz + s.x * cxz + s.y * (cyz + s.x * cxyz)};
  }
};

/// Where a line along an axis passes through phi = 0.
struct ZeroPlace {
  Vec3 share;
  Vec3 normal;  ///< outward; unit, or zero where phi is level
};

/// Calls `use(place)` for each passage through phi = 0 of lines along each axis in the box from
/// `low` to `low + side`. `lines`: where they stand, in shares of the side along both other axes.
/// Exact: along an axis phi is linear. What is 0 counts as outside, also where rounding makes it
/// negative, as it does in the faces of a block that lie in lattice planes.
template <class Use>
void for_each_zero(const Trilinear& phi, const Vec3& low, double side,
                   std::span<const double> lines, const Use& use) {
  const double rounding = phi.rounding();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double u : lines) {
      for (const double v : lines) {
        Vec3 begin = low;
        begin[(axis + 1) % 3] += side * u;
        begin[(axis + 2) % 3] += side * v;
        Vec3 end = begin;
        end[axis] += side;
        const double a = phi.value(begin);
        const double b = phi.value(end);
        if ((a < -rounding) == (b < -rounding)) continue;
        begin[axis] += side * std::clamp(a / (a - b), 0.0, 1.0);
        use(ZeroPlace{begin, normalized(phi.slope(begin))});
      }
    }
  }
}

/// Calls `use(share)` for each corner of a box where phi is 0: lines pass beside these, though the
/// edges of a block end in them.
template <class Use>
void for_each_zero_corner(const Trilinear& phi, const Vec3& low, double side, const Use& use) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at =
        low + side * Vec3{static_cast<double>(corner >> 2), static_cast<double>(corner >> 1 & 1),
                          static_cast<double>(corner & 1)};
    if (std::abs(phi.value(at)) <= phi.rounding()) use(at);
  }
}

}  // namespace argil::io
