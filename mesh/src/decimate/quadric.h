// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// The sum of weighted squared distances of a point x from planes and points:
/// x' A x - 2 b' x + c, with A symmetric.
struct Quadric {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;  ///< A
  Vec3 b;
  double c = 0.0;

  /// The plane through `point` with the unit normal `n`, and the point itself with `point_fraction`
  /// of that weight, which makes the least point unique and draws it to where the matter is.
  void add_plane(const Vec3& n, const Vec3& point, double weight, double point_fraction) noexcept {
    assert(weight >= 0.0 && point_fraction >= 0.0);
    const double offset = dot(n, point);
    const double point_weight = weight * point_fraction;
    xx += weight * n.x * n.x + point_weight;
    xy += weight * n.x * n.y;
    xz += weight * n.x * n.z;
    yy += weight * n.y * n.y + point_weight;
    yz += weight * n.y * n.z;
    zz += weight * n.z * n.z + point_weight;
    b += (weight * offset) * n + point_weight * point;
    c += weight * offset * offset + point_weight * dot(point, point);
  }

  Quadric& operator+=(const Quadric& q) noexcept {
    xx += q.xx;
    xy += q.xy;
    xz += q.xz;
    yy += q.yy;
    yz += q.yz;
    zz += q.zz;
    b += q.b;
    c += q.c;
    return *this;
  }
  friend Quadric operator+(Quadric a, const Quadric& q) noexcept { return a += q; }

  double at(const Vec3& x) const noexcept {
    const Vec3 ax{xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z,
                  xz * x.x + yz * x.y + zz * x.z};
    return std::max(0.0, dot(x, ax) - 2.0 * dot(b, x) + c);
  }

  /// Where it is least; nothing when that is not one point to the accuracy of doubles.
  std::optional<Vec3> least() const noexcept {
    const double m0 = yy * zz - yz * yz;
    const double m1 = xz * yz - xy * zz;
    const double m2 = xy * yz - xz * yy;
    const double determinant = xx * m0 + xy * m1 + xz * m2;
    const double size = xx + yy + zz;
    // Cramer's rule. The cube of the trace bounds the determinant of such a matrix; what is so much
    // smaller is the rounding of its terms.
    constexpr double kRounding = 1e-13;
    if (!(determinant > kRounding * size * size * size)) return std::nullopt;
    const Vec3 x{m0 * b.x + m1 * b.y + m2 * b.z,
                 m1 * b.x + (xx * zz - xz * xz) * b.y + (xy * xz - xx * yz) * b.z,
                 m2 * b.x + (xy * xz - xx * yz) * b.y + (xx * yy - xy * xy) * b.z};
    return x / determinant;
  }
};

}  // namespace argil::mesh
