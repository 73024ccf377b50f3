// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>

namespace argil {

/// A point, a direction or a triple of lengths. Double precision; the unit is in the name of the
/// variable that holds it (`position_mm`, `force_n`).
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr double& operator[](std::size_t axis) noexcept {
    return axis == 0 ? x : (axis == 1 ? y : z);
  }
  constexpr double operator[](std::size_t axis) const noexcept {
    return axis == 0 ? x : (axis == 1 ? y : z);
  }
  constexpr Vec3& operator+=(const Vec3& b) noexcept {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vec3& operator-=(const Vec3& b) noexcept {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  constexpr Vec3& operator*=(double s) noexcept {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  friend constexpr bool operator==(const Vec3&, const Vec3&) noexcept = default;
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) noexcept { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) noexcept { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) noexcept { return a *= s; }
constexpr Vec3 operator*(double s, Vec3 a) noexcept { return a *= s; }
constexpr Vec3 operator/(Vec3 a, double s) noexcept { return a *= 1.0 / s; }

constexpr double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }

/// The unit vector along `a`, or zero when `a` is zero (never NaN for finite input).
inline Vec3 normalized(const Vec3& a) noexcept {
  const double n = length(a);
  return n > 0.0 ? a / n : Vec3{};
}
inline bool is_finite(const Vec3& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Nothing lies farther from the origin along an axis: 1 km. What is read, typed or received from
/// beyond is refused where it comes in; what lies behind such a border relies on it.
inline constexpr double kMaxReachMm = 1e6;

/// Finite, and no coordinate beyond kMaxReachMm.
inline bool is_in_reach(const Vec3& a) noexcept {  // false for NaN
  return std::abs(a.x) <= kMaxReachMm && std::abs(a.y) <= kMaxReachMm &&
         std::abs(a.z) <= kMaxReachMm;
}

/// A rotation as a quaternion, scalar first. Rotating assumes unit length; `normalized` makes it
/// so.
struct Quat {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  friend constexpr bool operator==(const Quat&, const Quat&) noexcept = default;
};

/// The unit quaternion along `q`, or the identity when `q` is zero.
inline Quat normalized(const Quat& q) noexcept {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return n > 0.0 ? Quat{q.w / n, q.x / n, q.y / n, q.z / n} : Quat{};
}
constexpr Quat conjugate(const Quat& q) noexcept { return {q.w, -q.x, -q.y, -q.z}; }

/// `v` rotated by the unit quaternion `q`.
constexpr Vec3 rotate(const Quat& q, const Vec3& v) noexcept {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

/// An axis-aligned box. Empty (the default) when any `min` exceeds its `max`.
struct Box3 {
  Vec3 min{1.0, 1.0, 1.0};
  Vec3 max{-1.0, -1.0, -1.0};

  constexpr bool empty() const noexcept { return min.x > max.x || min.y > max.y || min.z > max.z; }
  constexpr void include(const Vec3& p) noexcept {
    if (empty()) {
      min = max = p;
      return;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      if (p[a] < min[a]) min[a] = p[a];
      if (p[a] > max[a]) max[a] = p[a];
    }
  }
  constexpr Vec3 size() const noexcept { return empty() ? Vec3{} : max - min; }
  constexpr Vec3 center() const noexcept { return (min + max) * 0.5; }
};

}  // namespace argil
