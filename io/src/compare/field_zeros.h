// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "argil/core/vec3.h"
#include "argil/engine/field_sampler.h"

namespace argil::io {

/// Where a line along an axis passes through phi = 0.
struct FieldZero {
  Vec3 fraction;
  Vec3 normal;  ///< outward; unit, or zero where phi is level
};

/// Calls `use(zero)` for each passage through phi = 0 of lines along each axis in the box from
/// `low` to `low + side`. `lines`: where they stand, as fractions of the side along both other
/// axes. Exact: along an axis phi is linear. What is 0 counts as outside, also where rounding makes
/// it negative, as it does in the faces of a block that lie in lattice planes.
template <class Use>
void for_each_zero(const Trilinear& phi, const Vec3& low, double side,
                   std::span<const double> lines, const Use& use) {
  assert(side > 0.0);
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
        use(FieldZero{begin, normalized(phi.slope(begin))});
      }
    }
  }
}

/// Calls `use(fraction)` for each corner of a box where phi is 0: lines pass beside these, though
/// the edges of a block end in them.
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
