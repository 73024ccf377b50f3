// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "argil/core/simd.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// The signed distance to waves as a small network of sines remembers it: section 3.6.4 of the
/// Falcon report. Its place is beside SineScene, whose depth is measured straight down: this one
/// knows the way to the nearest point, and the normal there.
///
/// The waves are z = A sin(2 pi x / l) cos(2 pi y / l) with A = l / 10, and only those: other
/// shapes want other weights, made by evaluation/normals/train_sine_network.py. Two layers of 16
/// sines on sin(2 pi x / l), cos(2 pi y / l) and z / l: so it is periodic and mirrored where the
/// waves are, with no seam.
///
/// Accuracy     from kBelow wavelengths below the surface to kAbove above it: tests SineNetwork.*.
///              Elsewhere it rounds the creases of the true distance, with its sign. Beyond |z| =
///              kSlab it goes on straight along z.
/// Determinism  the same bits on every instruction set: SineNetworkSimd.*.
/// Threads      Realtime: noexcept, no allocation, lock or system call.
/// Cost         fixed: 16 x 16 x 2 + 16 x 7 multiplications, 68 sines and the sums, without a
///              branch; measured by `argil chart normals`.
/// Source       section 3.6.4 of the Falcon report (docs/equations.md); V. Sitzmann, J. Martel,
///              A. Bergman, D. Lindell, G. Wetzstein, "Implicit neural representations with
///              periodic activation functions", NeurIPS 2020. Ours differs: its first inputs are
///              the waves' own sines, and it was trained by least squares.
class SineNetwork {
 public:
  static constexpr double kAmplitude = 0.1;  ///< all four in wavelengths
  static constexpr double kBelow = 0.16;
  static constexpr double kAbove = 0.04;
  static constexpr double kSlab = 0.26;

  /// `wave_mm`: l, > 0. `simd`: one that this machine has.
  explicit SineNetwork(double wave_mm, Simd simd = best_simd()) noexcept;

  struct Answer {
    double distance_mm = 0.0;  ///< negative inside
    Vec3 gradient;             ///< of the distance answered, so not quite of unit length
  };
  /// At a place whose z counts from the middle of the waves; every part at most 1e9 mm.
  Answer at(const Vec3& place_mm) const noexcept;

  /// What its weights take.
  static std::size_t bytes() noexcept;

 private:
  double wave_mm_;
  Simd simd_;
};

}  // namespace argil::haptics
