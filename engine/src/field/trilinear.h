// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

#include "argil/core/vec3.h"

namespace argil {

/// The trilinear value between the eight nodes from `low` on, at `fraction` of a voxel along each
/// axis, of a lattice of `count` nodes stored z fastest.
inline double trilinear(const std::vector<float>& value, const std::array<std::size_t, 3>& count,
                        const std::array<std::size_t, 3>& low, const Vec3& fraction) noexcept {
  assert(value.size() == count[0] * count[1] * count[2]);
  assert(low[0] + 1 < count[0] && low[1] + 1 < count[1] && low[2] + 1 < count[2]);
  double sum = 0.0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<std::size_t, 3> node = low;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t up = (corner >> (2 - a)) & 1U;
      node[a] += up;
      weight *= up != 0 ? fraction[a] : 1.0 - fraction[a];
    }
    sum += weight * static_cast<double>(value[(node[0] * count[1] + node[1]) * count[2] + node[2]]);
  }
  return sum;
}

}  // namespace argil
