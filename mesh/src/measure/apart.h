// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {

/// Whether a plane across `normal`, of any length, certainly lies between two triangles.
inline bool is_between(const Vec3& normal, const Corners& a, const Corners& b) noexcept {
  std::array<double, 2> low;
  std::array<double, 2> high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-low[0]);
  double reach = 0.0;
  for (std::size_t which = 0; which < 2; ++which) {
    for (const Vec3& corner : which == 0 ? a : b) {
      const Vec3 from = corner - a[0];
      const double along = dot(normal, from);
      low[which] = std::min(low[which], along);
      high[which] = std::max(high[which], along);
      reach = std::max(reach, std::abs(from.x) + std::abs(from.y) + std::abs(from.z));
    }
  }
  // Differences, products and sums round four times by 2^-53 at most; twice for two corners, and
  // with room to spare.
  constexpr double kRounding = 1e-14;
  constexpr double kLeast = 1e-280;  // below, digits may be lost
  const double rounding =
      kRounding * reach * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) + kLeast;
  return low[0] > high[1] + rounding || low[1] > high[0] + rounding;
}

/// Whether two triangles certainly have no point in common: planes along one of them, and across it
/// through its sides, are tried in doubles, with a bound of their error. False says nothing; those
/// along a side of both decide too seldom to be worth it.
///
/// Cost    15 ns where the first decide, as nearly always; 60 ns for all.
/// Source  S. Gottschalk, M. Lin, D. Manocha, "OBBTree", 1996: separating axes.
inline bool are_apart(const Corners& a, const Corners& b) noexcept {
  for (const Corners& of : {a, b}) {
    const std::array<Vec3, 3> sides{of[1] - of[0], of[2] - of[1], of[0] - of[2]};
    const Vec3 normal = cross(sides[0], sides[1]);
    if (is_between(normal, a, b)) return true;
    for (const Vec3& side : sides) {
      if (is_between(cross(side, normal), a, b)) return true;
    }
  }
  return false;
}

}  // namespace argil::mesh
