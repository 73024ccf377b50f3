// SPDX-License-Identifier: GPL-3.0-or-later
// Do two triangles of one cell touch in more than what they share? Everything near zero counts as
// a touch: the answer only decides whether a cell is filled by pyramids, dearer and always valid.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "surface/contour_loop.h"

namespace argil {

namespace {

using TrianglePoints = std::array<Vec3, 3>;

// Lengths are in cell sizes here, so that one number serves.
constexpr double kFlat = 1e-12;

struct Plane {
  Vec3 normal;
  Vec3 origin;
  explicit Plane(const TrianglePoints& t) : normal(cross(t[1] - t[0], t[2] - t[0])), origin(t[0]) {}
  double height(const Vec3& p) const { return dot(normal, p - origin); }
};

bool one_side(double a, double b) { return (a > kFlat && b > kFlat) || (a < -kFlat && b < -kFlat); }
bool flat(double a) { return std::abs(a) <= kFlat; }

// Where the segment a-b, with heights of opposite sign or zero, meets the plane.
Vec3 crossing_point(const Vec3& a, double height_a, const Vec3& b, double height_b) {
  const double span = height_a - height_b;
  if (flat(span)) return (a + b) * 0.5;
  const double t = height_a / span;
  return a + (b - a) * (t < 0.0 ? 0.0 : (t > 1.0 ? 1.0 : t));
}

// Two triangles over one common edge cover each other only when folded flat.
bool folded(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Vec3 edge = b - a;
  const Vec3 n1 = cross(edge, p - a);
  const Vec3 n2 = cross(edge, q - a);
  const Vec3 sine = cross(n1, n2);
  return dot(sine, sine) <= kFlat * kFlat && dot(n1, n2) > 0.0;
}

// Wedges s-a0-a1 and s-b0-b1 in one plane with normal n: apart when some boundary ray of one has
// the other wedge wholly on its far side.
bool wedges_overlap(const Vec3& s, const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b,
                    const Vec3& n) {
  const auto turn = [&](const Vec3& u, const Vec3& v) { return dot(n, cross(u - s, v - s)); };
  const auto beyond = [&](const Vec3& ray, const Vec3& own, const std::array<Vec3, 2>& other) {
    const double sign = turn(ray, own) > 0.0 ? 1.0 : -1.0;
    return sign * turn(ray, other[0]) < -kFlat && sign * turn(ray, other[1]) < -kFlat;
  };
  return !(beyond(a[0], a[1], b) || beyond(a[1], a[0], b) || beyond(b[0], b[1], a) ||
           beyond(b[1], b[0], a));
}

// One common vertex s. The planes meet in a line through s; each triangle covers a stretch of it
// from s to its opposite side, or only s.
bool cross_at_vertex(const Vec3& s, const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const Plane plane_a({s, a[0], a[1]});
  const Plane plane_b({s, b[0], b[1]});
  const double a0 = plane_b.height(a[0]);
  const double a1 = plane_b.height(a[1]);
  if (one_side(a0, a1)) return false;
  const double b0 = plane_a.height(b[0]);
  const double b1 = plane_a.height(b[1]);
  if (one_side(b0, b1)) return false;
  if (flat(a0) && flat(a1)) return wedges_overlap(s, a, b, plane_a.normal);
  return dot(crossing_point(a[0], a0, a[1], a1) - s, crossing_point(b[0], b0, b[1], b1) - s) > 0.0;
}

// The stretch of line `along` that triangle t covers, given its heights over the other's plane.
std::array<double, 2> stretch(const TrianglePoints& t, const std::array<double, 3>& height,
                              const Vec3& along) {
  std::array<double, 2> range{1e300, -1e300};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (one_side(height[i], height[j])) continue;
    const double at = dot(along, crossing_point(t[i], height[i], t[j], height[j]));
    range = {std::min(range[0], at), std::max(range[1], at)};
  }
  return range;
}

// No common vertex: the line where the planes meet leads through both triangles, and they cross
// when their stretches of it overlap.
bool cross_apart(const TrianglePoints& a, const TrianglePoints& b) {
  const Plane plane_a(a);
  const Plane plane_b(b);
  const std::array<double, 3> ha{plane_b.height(a[0]), plane_b.height(a[1]), plane_b.height(a[2])};
  if (one_side(ha[0], ha[1]) && one_side(ha[1], ha[2])) return false;
  const std::array<double, 3> hb{plane_a.height(b[0]), plane_a.height(b[1]), plane_a.height(b[2])};
  if (one_side(hb[0], hb[1]) && one_side(hb[1], hb[2])) return false;
  const Vec3 along = cross(plane_a.normal, plane_b.normal);
  const auto ra = stretch(a, ha, along);
  const auto rb = stretch(b, hb, along);
  return ra[0] <= rb[1] + kFlat && rb[0] <= ra[1] + kFlat;
}

// Turns both triangles so that what they share comes first, and counts it.
int align_shared(Triangle& a, Triangle& b) {
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(b.begin() + shared, b.end(), a[i]);
    if (found == b.end()) continue;
    const auto to = static_cast<std::size_t>(shared++);
    std::swap(b[to], *found);
    std::swap(a[to], a[i]);
  }
  return shared;
}

template <class At>
bool pair_crosses(Triangle a, Triangle b, const At& at) {
  switch (align_shared(a, b)) {
    case 0:
      return cross_apart({at(a[0]), at(a[1]), at(a[2])}, {at(b[0]), at(b[1]), at(b[2])});
    case 1:
      return cross_at_vertex(at(a[0]), {at(a[1]), at(a[2])}, {at(b[1]), at(b[2])});
    case 2:
      return folded(at(a[0]), at(a[1]), at(a[2]), at(b[2]));
    default:
      return true;
  }
}

template <class At>
bool any_cross(std::span<const Triangle> triangles, const At& at) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (pair_crosses(triangles[i], triangles[j], at)) return true;
    }
  }
  return false;
}

double single_precision(double v) { return static_cast<double>(static_cast<float>(v)); }

}  // namespace

bool triangles_cross(const ContourMesh& mesh, std::size_t first, double size_mm) {
  assert(first <= mesh.triangles.size() && size_mm > 0.0);
  const auto triangles = std::span(mesh.triangles).subspan(first);
  if (triangles.size() < 2) return false;
  const Vec3 origin = mesh.positions[triangles[0][0]];
  const double scale = 1.0 / size_mm;
  const auto exact = [&](std::uint32_t v) { return (mesh.positions[v] - origin) * scale; };
  const auto as_float = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return (Vec3{single_precision(p.x), single_precision(p.y), single_precision(p.z)} - origin) *
           scale;
  };
  return any_cross(triangles, exact) || any_cross(triangles, as_float);
}

}  // namespace argil
