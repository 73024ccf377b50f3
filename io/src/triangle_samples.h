// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "argil/core/vec3.h"

namespace argil::io {

inline double longest_side(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  return std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
}

/// Into how many parts to split each side, 1 to `most`, so that no part is much longer than `step`.
inline int splits_for(double side, double step, int most) noexcept {
  const double parts = side / step;
  return parts >= most ? most : std::max(1, static_cast<int>(std::lround(parts)));
}

/// Calls `use(weights)` with the barycentric weights of the middles of the n^2 like triangles that
/// n parts a side make; each stands for the same area.
template <class Use>
void for_each_sample(int n, Use&& use) {
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

}  // namespace argil::io
