// SPDX-License-Identifier: GPL-3.0-or-later
// Two triangles are nearest at a corner of one, or between two of their edges, or a side of one
// goes through the other.
#include "measure/triangle_distance.h"

#include <algorithm>
#include <optional>

namespace argil::mesh {
namespace {

double length2(const Vec3& v) noexcept { return dot(v, v); }

/// A part of a whole that may be nothing.
double fraction(double part, double whole) noexcept {
  return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
}

ClosestPoints between(const Vec3& a, const Vec3& b) noexcept { return {length2(a - b), a, b}; }

ClosestPoints of_segments(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2) noexcept {
  const Vec3 d1 = q1 - p1;
  const Vec3 d2 = q2 - p2;
  const Vec3 r = p1 - p2;
  const double a = length2(d1);
  const double e = length2(d2);
  const double c = dot(d1, r);
  const double f = dot(d2, r);
  const double b = dot(d1, d2);
  // Where they are parallel, any place on the first will do.
  double s = fraction(b * f - c * e, a * e - b * b);
  double t = e > 0.0 ? (b * s + f) / e : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = fraction(b * t - c, a);
  } else if (e <= 0.0) {
    s = fraction(-c, a);
  }
  return between(p1 + s * d1, p2 + t * d2);
}

/// Where the foot of a point lies within a triangle: else an edge or a corner is nearer.
std::optional<Vec3> foot_within(const Vec3& p, const Corners& t) noexcept {
  const Vec3 normal = area_normal(t);
  const double n2 = length2(normal);
  if (!(n2 > 0.0)) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), normal) < 0.0) return std::nullopt;
  }
  return p - (dot(p - t[0], normal) / n2) * normal;
}

/// Where a segment goes through a triangle.
std::optional<Vec3> crossing(const Vec3& p, const Vec3& q, const Corners& t) noexcept {
  const Vec3 normal = area_normal(t);
  const double from = dot(p - t[0], normal);
  const double to = dot(q - t[0], normal);
  if ((from > 0.0) == (to > 0.0)) return std::nullopt;
  const Vec3 at = p + from / (from - to) * (q - p);
  return foot_within(at, t) ? std::optional(at) : std::nullopt;
}

void take_nearer(const ClosestPoints& found, ClosestPoints& nearest) noexcept {
  if (found.distance2 < nearest.distance2) nearest = found;
}

}  // namespace

ClosestPoints closest_points(const Corners& a, const Corners& b) noexcept {
  ClosestPoints nearest = between(a[0], b[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = a[i];
    const Vec3& q = a[(i + 1) % 3];
    if (const auto at = crossing(p, q, b)) return {0.0, *at, *at};
    if (const auto at = crossing(b[i], b[(i + 1) % 3], a)) return {0.0, *at, *at};
    if (const auto foot = foot_within(p, b)) take_nearer(between(p, *foot), nearest);
    if (const auto foot = foot_within(b[i], a)) take_nearer(between(*foot, b[i]), nearest);
    for (std::size_t j = 0; j < 3; ++j) {
      take_nearer(of_segments(p, q, b[j], b[(j + 1) % 3]), nearest);
    }
  }
  return nearest;
}

}  // namespace argil::mesh
