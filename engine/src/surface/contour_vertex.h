// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// How far a cut keeps from the ends of its lattice edge, as a fraction of the edge. Measured in
/// docs/surface.md: the larger, the fewer slivers and the more deviation.
inline constexpr double kCutClamp = 0.02;

/// Where the field passes zero between the low and the high end of an edge, as a fraction of it,
/// kept off both.
inline double cut_parameter(double low, double high) noexcept {
  const double t = low / (low - high);
  return t > kCutClamp ? (t < 1.0 - kCutClamp ? t : 1.0 - kCutClamp) : kCutClamp;
}

}  // namespace argil
