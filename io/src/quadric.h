// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>

#include "argil/core/vec3.h"

namespace argil::io {

/// The sum of weighted squared distances of a place x from planes and points:
/// x' A x - 2 b' x + c, with A symmetric.
struct Quadric {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;  ///< A
  Vec3 b;
  double c = 0.0;

  /// The plane through `place` with the unit normal `n`, and the place itself with `point_share`
  /// of that weight, which makes the least place unique and draws it to where the matter is.
  void add_plane(const Vec3& n, const Vec3& place, double weight, double point_share) noexcept {
    const double offset = dot(n, place);
    const double point = weight * point_share;
    xx += weight * n.x * n.x + point;
    xy += weight * n.x * n.y;
    xz += weight * n.x * n.z;
    yy += weight * n.y * n.y + point;
    yz += weight * n.y * n.z;
    zz += weight * n.z * n.z + point;
    b += (weight * offset) * n + point * place;
    c += weight * offset * offset + point * dot(place, place);
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

  /// Where it is least; nothing when that is not one place to the accuracy of doubles.
  std::optional<Vec3> least() const noexcept {
    const double m0 = yy * zz - yz * yz;
    const double m1 = xz * yz - xy * zz;
    const double m2 = xy * yz - xz * yy;
    const double determinant = xx * m0 + xy * m1 + xz * m2;
    const double size = xx + yy + zz;
    constexpr double kRounding = 1e-13;
    if (!(determinant > kRounding * size * size * size)) return std::nullopt;
    const Vec3 x{m0 * b.x + m1 * b.y + m2 * b.z,
                 m1 * b.x + (xx * zz - xz * xz) * b.y + (xy * xz - xx * yz) * b.z,
                 m2 * b.x + (xy * xz - xx * yz) * b.y + (xx * yy - xy * xy) * b.z};
    return x / determinant;
  }
};

}  // namespace argil::io
