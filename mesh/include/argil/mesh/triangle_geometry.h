// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::mesh {

/// Counter-clockwise seen from outside, as the triangle names them.
using Corners = std::array<Vec3, 3>;

/// The triangle and its vertices must exist.
inline Corners corners_of(const TriangleMesh& mesh, std::size_t triangle) noexcept {
  assert(triangle < mesh.triangles.size());
  const auto& [a, b, c] = mesh.triangles[triangle];
  assert(std::max({a, b, c}) < mesh.positions.size());
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

/// The centroid.
inline Vec3 middle(const Corners& c) noexcept { return (c[0] + c[1] + c[2]) / 3.0; }

/// Normal to the triangle and as long as twice its area; outward where it faces outward. Rounding
/// may make it zero for a sliver and not zero for a triangle without area: degenerate_triangles is
/// what tells.
inline Vec3 area_normal(const Corners& c) noexcept { return cross(c[1] - c[0], c[2] - c[0]); }
inline double triangle_area(const Corners& c) noexcept { return 0.5 * length(area_normal(c)); }

/// In the unit of the corners; one square root.
inline double longest_side(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  return std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
}
inline double longest_side(const Corners& c) noexcept { return longest_side(c[0], c[1], c[2]); }

/// Whether a triangle is cut into parts: it has a side of more than one and a half steps.
inline bool is_longer_than_a_part(const Corners& c, double step) noexcept {
  assert(step > 0.0);
  return longest_side(c) > 1.5 * step;
}

/// Calls `use(part)` for parts that are no longer than that and together are the triangle: strips
/// from its sharpest corner on, so that a slender one has as many as it is long. The order of the
/// calls is the same every time.
template <class Use>
void for_each_part(const Corners& c, double step, const Use& use) {
  if (!is_longer_than_a_part(c, step)) {
    use(c);
    return;
  }
  std::size_t shortest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    const auto length2 = [&](std::size_t of) {
      return dot(c[(of + 1) % 3] - c[of], c[(of + 1) % 3] - c[of]);
    };
    if (length2(k) < length2(shortest)) shortest = k;
  }
  const Vec3& apex = c[(shortest + 2) % 3];
  const Vec3 left = c[shortest] - apex;
  const Vec3 right = c[(shortest + 1) % 3] - apex;
  const double strips = std::ceil(longest_side(c) / step);
  for (double n = 0.0; n < strips; ++n) {
    const double from = n / strips;
    const double to = (n + 1.0) / strips;
    const Corners upper{apex + from * left, apex + to * left, apex + to * right};
    for_each_part(upper, step, use);
    if (n == 0.0) continue;
    for_each_part(Corners{apex + from * left, apex + to * right, apex + from * right}, step, use);
  }
}

/// Into how many parts to split each side, 1 to `most`, so that no part is much longer than `step`:
/// rounded to the nearest number, so that a part has at most 1.5 steps where `most` allows it.
inline int splits_for(double side, double step, int most) noexcept {
  assert(step > 0.0 && most >= 1);
  const double parts = side / step;
  return parts >= most ? most : std::max(1, static_cast<int>(std::lround(parts)));
}

/// Calls `use(weights)` with the barycentric weights of the centroids of the n^2 congruent
/// triangles that n parts a side make; each stands for the same area. Weights are of the corners in
/// their order and add up to 1; none is 0, so that no sample lies on a side. The order of the calls
/// is the same every time.
template <class Use>
void for_each_sample(int n, Use&& use) {
  assert(n >= 1);
  const double third = 1.0 / (3.0 * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      use(std::array<double, 3>{(3 * (n - i - j) - 2) * third, (3 * i + 1) * third,
                                (3 * j + 1) * third});
      if (i + j + 1 == n) continue;
      use(std::array<double, 3>{(3 * (n - i - j) - 4) * third, (3 * i + 2) * third,
                                (3 * j + 2) * third});
    }
  }
}

}  // namespace argil::mesh
