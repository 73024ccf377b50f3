// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// Number `i` of `count` unit vectors that lie evenly all around, on a spiral.
/// Source  R. Swinbank, R. Purser, "Fibonacci grids: a novel approach to global modelling", 2006.
inline Vec3 direction_around(std::size_t i, std::size_t count) {
  assert(i < count);
  const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
  const double turn = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace argil::mesh
