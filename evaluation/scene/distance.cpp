// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distances in closed form, exact everywhere unless their declaration says otherwise.
#include "scene/distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::evaluation {

Distance ball(double radius_mm) {
  return [radius_mm](const Vec3& p) { return length(p) - radius_mm; };
}

Distance torus(double ring_mm, double tube_mm) {
  assert(tube_mm > 0.0 && tube_mm < ring_mm);
  return [=](const Vec3& p) {
    const double from_ring = std::sqrt(p.x * p.x + p.y * p.y) - ring_mm;
    return std::sqrt(from_ring * from_ring + p.z * p.z) - tube_mm;
  };
}

Distance box(const Vec3& half_mm, double rounding_mm) {
  assert(rounding_mm >= 0.0 && rounding_mm < std::min({half_mm.x, half_mm.y, half_mm.z}));
  const Vec3 inner = half_mm - Vec3{rounding_mm, rounding_mm, rounding_mm};
  return [=](const Vec3& p) {
    const Vec3 d{std::abs(p.x) - inner.x, std::abs(p.y) - inner.y, std::abs(p.z) - inner.z};
    // Inside the nearest face decides; outside the offsets that are positive add up as a vector.
    const double deepest = std::max({d.x, d.y, d.z});
    if (deepest <= 0.0) return deepest - rounding_mm;
    return length({std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)}) - rounding_mm;
  };
}

Distance turned(const Quat& by, Distance body) {
  const Quat back = conjugate(by);
  const Vec3 x = rotate(back, Vec3{1, 0, 0});
  const Vec3 y = rotate(back, Vec3{0, 1, 0});
  const Vec3 z = rotate(back, Vec3{0, 0, 1});
  return [x, y, z, body = std::move(body)](const Vec3& p) {
    return body(p.x * x + p.y * y + p.z * z);
  };
}

Vec3 direction(const Distance& distance, const Vec3& point, double probe_mm) {
  assert(probe_mm > 0.0);
  Vec3 sum;
  // A tetrahedron takes four distances for a gradient; differences along three axes take six.
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    sum += distance(point + probe_mm * corner) * corner;
  }
  return normalized(sum);
}

}  // namespace argil::evaluation
