// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>

namespace argil {

/// A point, a direction or a triple of lengths. Double precision; the unit is in the name of the
/// variable that holds it (`position_mm`, `force_n`). All operations here are noexcept, do not
/// allocate and can be used on any thread, the servo's too.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  /// Axis 0 is x, 1 is y, 2 is z; nothing is checked, and any greater number means z.
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
  /// Number by number, without a tolerance: 0 equals -0, and what has a NaN equals nothing.
  friend constexpr bool operator==(const Vec3&, const Vec3&) noexcept = default;
};

// The usual arithmetic, component by component, each rounded once: Argil is built without fused
// multiply-add (-ffp-contract=off), so that the bits are the same in every build. In a program that
// is built otherwise these inline functions may give other last bits.
constexpr Vec3 operator+(Vec3 a, const Vec3& b) noexcept { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) noexcept { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) noexcept { return a *= s; }
constexpr Vec3 operator*(double s, Vec3 a) noexcept { return a *= s; }
/// Multiplies by the reciprocal: one division, and bits that may differ from three. By 0 it gives
/// infinities and NaN.
constexpr Vec3 operator/(Vec3 a, double s) noexcept { return a *= 1.0 / s; }

/// The scalar product, summed in the order x, y, z. The order is part of the contract: hashes of a
/// clay depend on it.
constexpr double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// The vector product of a right-handed frame: x cross y is z (Vec3.CrossesRightHanded). Of nearly
/// parallel vectors digits cancel: the error is relative to |a| |b|, not to the result.
constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The Euclidean length. Squares overflow beyond 1e154, far outside of kMaxReachMm, and vanish
/// below 1e-162. A correctly rounded square root, as IEEE 754 asks for, and so the same bits on any
/// machine.
inline double length(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }

/// The unit vector along `a`, or zero when `a` is zero (never NaN for finite input); zero as well
/// where the squares of `length` vanish or overflow. Its length is 1 but for a few roundings.
inline Vec3 normalized(const Vec3& a) noexcept {
  const double n = length(a);
  return n > 0.0 ? a / n : Vec3{};
}
/// Neither an infinity nor NaN in any component.
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

/// A rotation as a quaternion, scalar first: by the angle t about the unit axis u it is
/// (cos t/2, u sin t/2), counter-clockwise seen from the tip of u (Quat.RotatesByTheRightHandRule).
/// The default turns nothing. Rotating assumes unit length; `normalized` makes it so.
///
/// q and -q are the same rotation but compare as different.
struct Quat {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  friend constexpr bool operator==(const Quat&, const Quat&) noexcept = default;
};

/// The unit quaternion along `q`, or the identity when `q` is zero
/// (Quat.NormalizesZeroToTheIdentity). Components must stay below 1e154, as the squares of
/// `length`.
inline Quat normalized(const Quat& q) noexcept {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return n > 0.0 ? Quat{q.w / n, q.x / n, q.y / n, q.z / n} : Quat{};
}
/// The inverse rotation of a unit quaternion: rotating by both gives the vector back but for
/// rounding (Quat.IsUndoneByItsConjugate).
constexpr Quat conjugate(const Quat& q) noexcept { return {q.w, -q.x, -q.y, -q.z}; }

/// `v` rotated by the unit quaternion `q`; with another length of `q` the result is wrong, not
/// scaled. Two cross products instead of the full product q v q*.
constexpr Vec3 rotate(const Quat& q, const Vec3& v) noexcept {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

/// An axis-aligned box with its bounds included. Empty (the default) when any `min` exceeds its
/// `max`; a box of one point is not empty, and its size is zero. All boxes that are empty mean the
/// same, whatever their numbers.
struct Box3 {
  Vec3 min{1.0, 1.0, 1.0};
  Vec3 max{-1.0, -1.0, -1.0};

  constexpr bool empty() const noexcept { return min.x > max.x || min.y > max.y || min.z > max.z; }
  /// Grows to hold `p`, which must not be NaN; an empty box becomes that point.
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
  /// Whether two boxes, borders included, come within a margin of each other along every axis;
  /// neither may be empty.
  constexpr bool meets(const Box3& other, double margin = 0.0) const noexcept {
    for (std::size_t a = 0; a < 3; ++a) {
      if (min[a] > other.max[a] + margin || other.min[a] > max[a] + margin) return false;
    }
    return true;
  }
  /// Its sides; zero for an empty box.
  constexpr Vec3 size() const noexcept { return empty() ? Vec3{} : max - min; }
  /// Its middle; the origin for the default box, and without meaning for any other empty one.
  constexpr Vec3 center() const noexcept { return (min + max) * 0.5; }
};

}  // namespace argil
