// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "force/force_law.h"
#include "force/lattice_sums.h"

namespace argil::haptics {

/// A function of the distance as cubic pieces of equal width, from where it is a straight line
/// (deep inside) to where it is zero (outside).
struct LawTable {
  double low_mm = 0.0;
  double per_mm = 0.0;  ///< segments per mm
  std::array<std::array<float, kLawSegments>, 4> coefficient{};

  /// The function at a distance.
  double at(double phi_mm) const noexcept;
};

/// Phi, or f_c0 times the pressure, of the distance, filtered to what a lattice of this spacing can
/// carry: convolved with the cubic convolution kernel (Catmull-Rom) of four voxels width. Its
/// second moment vanishes and its spectrum is zero at the lattice's own frequency, so that the
/// edge of the skin and the clamp are summed without aliasing and a smooth law stays what it is.
///
/// Cost   32 quadratures: 5 us, 25 with an exponent that is not whole. Does not allocate.
/// Source the kernel: R. Keys, "Cubic convolution interpolation for digital image processing",
///        IEEE Trans. ASSP 29 (1981), a = -1/2. Used here on the law's argument, not on the field.
LawTable filtered_potential(const ContactLaw& law, double voxel_mm) noexcept;
LawTable filtered_pressure(const ContactLaw& law, double voxel_mm) noexcept;

}  // namespace argil::haptics
