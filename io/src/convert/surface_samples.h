// SPDX-License-Identifier: GPL-3.0-or-later
// Points spread over triangles so that every cell of a grid that a triangle passes through has
// some.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "argil/core/vec3.h"

namespace argil::io {

/// So many that they are at most two thirds of a cell apart.
inline int samples_along(double length, double cell) {
  return std::max(1, static_cast<int>(std::ceil(1.5 * length / cell)));
}

/// Calls `visit(point, area)` with points of a triangle, each in the middle of its share of the
/// area; the shares add up to the whole.
///
/// Cost  2.25 of them for each square cell of its area, and 1.5 for each cell along its longest
///       side: a sliver costs as its length, not as the square of it.
template <class Visit>
void for_each_sample(const std::array<Vec3, 3>& t, double cell, const Visit& visit) {
  // Strips along the longest side, from there to the corner across.
  std::size_t across = 0;
  double longest = 0.0;
  for (std::size_t n = 0; n < 3; ++n) {
    const double side = length(t[(n + 2) % 3] - t[(n + 1) % 3]);
    if (!(side > longest)) continue;
    longest = side;
    across = n;
  }
  if (!(longest > 0.0)) return;
  const Vec3& from = t[(across + 1) % 3];
  const Vec3 along = t[(across + 2) % 3] - from;
  const Vec3 up = t[across] - from;
  const double area = 0.5 * length(cross(along, up));
  const int strips = samples_along(2.0 * area / longest, cell);
  for (int k = 0; k < strips; ++k) {
    const double height = (k + 0.5) / strips;
    const double width = 1.0 - height;
    const int count = samples_along(width * longest, cell);
    const double share = 2.0 * area * width / strips / count;
    for (int i = 0; i < count; ++i) {
      visit(from + height * up + ((i + 0.5) / count * width) * along, share);
    }
  }
}

}  // namespace argil::io
