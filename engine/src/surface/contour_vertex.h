// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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

/// Lattice edges that the surface cuts, many at once, a lane each, and the vertices on them. Every
/// lane is computed as if it were alone.
struct CutEdges {
  static constexpr std::size_t kLanes = 32;
  template <class T>
  using Lanes = std::array<T, kLanes>;
  template <class T>
  using Vectors = std::array<Lanes<T>, 3>;

  alignas(64) Lanes<float> low;            ///< the value at the low end
  alignas(64) Lanes<float> high;           ///< at the other; of another side
  alignas(64) Vectors<std::int32_t> node;  ///< the low end
  alignas(64) Vectors<double> along;       ///< 1 on the edge's axis, else 0
  alignas(64) Vectors<float> before;       ///< gradient at the low end, times anything
  alignas(64) Vectors<float> after;        ///< at the other, times the same

  alignas(64) Vectors<double> position;  ///< mm
  alignas(64) Vectors<double> normal;    ///< unit, where `square` is positive
  alignas(64) Lanes<double> square;      ///< of the gradient between: NaN where an input was

  /// Fills the last three for all lanes; those that nothing was put into give what they give.
  void compute(double voxel_mm) noexcept;
};

}  // namespace argil
