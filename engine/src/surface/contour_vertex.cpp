// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over lanes, each a plain formula, which the compiler turns into vector instructions.
#include "surface/contour_vertex.h"

#include <cmath>

namespace argil {

void CutEdges::compute(double voxel_mm) noexcept {
  alignas(64) Lanes<double> t;
  for (std::size_t n = 0; n < kLanes; ++n) {
    t[n] = cut_parameter(static_cast<double>(low[n]), static_cast<double>(high[n]));
  }
  alignas(64) Vectors<double> between;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < kLanes; ++n) {
      position[axis][n] = (static_cast<double>(node[axis][n]) + along[axis][n] * t[n]) * voxel_mm;
      const auto from = static_cast<double>(before[axis][n]);
      between[axis][n] = from + t[n] * (static_cast<double>(after[axis][n]) - from);
    }
  }
  for (std::size_t n = 0; n < kLanes; ++n) {
    square[n] = between[0][n] * between[0][n] + between[1][n] * between[1][n] +
                between[2][n] * between[2][n];
  }
  for (std::size_t n = 0; n < kLanes; ++n) t[n] = 1.0 / std::sqrt(square[n]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < kLanes; ++n) normal[axis][n] = between[axis][n] * t[n];
  }
}

}  // namespace argil
