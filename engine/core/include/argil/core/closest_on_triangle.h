// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil {

/// The point of the triangle a, b, c that is closest to `p`. A triangle without area is a segment
/// or a point.
///
/// Shapes       finite points; the corners in either order of turning.
/// Units        any length; the same for all four points.
/// Returns      a corner where that is closest, with its very bits; on a side or on the face a
///              weighted mean of corners, which rounding may put a little off the triangle.
/// Accuracy     the rounding of double arithmetic.
/// Determinism  the corners' order decides rounding, and which of several corners in one place is
///              returned: give the same order for the same bits.
/// Threads      any; noexcept, does not allocate.
/// Cost         about 30 multiplications and at most one division.
/// Source       C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
inline Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                const Vec3& c) noexcept {
  // d1 to d6 place `p`, seen from each corner, along the sides ab and ac. Each return answers for
  // one Voronoi region of the triangle: a corner, a side or, last, the face.
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  // va, vb, vc: barycentric weights of a, b and c before scaling; negative beyond the far side.
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return a + ab * (d1 / (d1 - d3));
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  const double toward_b = d4 - d3;
  const double toward_c = d5 - d6;
  if (va <= 0.0 && toward_b >= 0.0 && toward_c >= 0.0) {
    const double both = toward_b + toward_c;
    return both > 0.0 ? b + (c - b) * (toward_b / both) : b;
  }
  const double scale = 1.0 / (va + vb + vc);  // positive: zero area was caught by an edge above
  return a + ab * (vb * scale) + ac * (vc * scale);
}

}  // namespace argil
