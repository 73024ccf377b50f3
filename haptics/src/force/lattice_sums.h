// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace argil::haptics {

// The inner loop of LatticeForce, compiled once for each instruction set. What is included here
// must not define inline functions: the linker would keep one copy of each, perhaps that of an
// instruction set the machine does not have.

inline constexpr int kLawSegments = 32;

enum class SumShape { ball, ellipsoid, box, capsule };

/// A query in units of one voxel, in the frame of the window's nodes ("r") or the tool's ("q").
struct LatticeJob {
  SumShape shape = SumShape::ball;
  bool blanch = false;
  const float* values = nullptr;  ///< of the whole window
  std::ptrdiff_t count = 0;
  int nodes[3] = {};
  int low[3] = {};  ///< first and last node to visit along each axis, within the window
  int high[3] = {};
  double center[3] = {};   ///< the tool's, in nodes
  double axes[3][3] = {};  ///< row a: the tool's axis a in the frame of the nodes
  double reach[3] = {};    ///< half extents of the kernel along the tool's axes
  double segment = 0.0;    ///< half length of a capsule's axis
  float law_low = 0.0F;    ///< phi in mm where the table of the law starts
  float law_per_mm = 0.0F;
  float skin_inverse = 0.0F;   ///< 1 / mm
  float voxel_inverse = 0.0F;  ///< 1 / mm
  float law_offset = 0.0F;     ///< taken from every value of the law: see LatticeForce
  const float* law = nullptr;  ///< 4 x kLawSegments: cubic of each segment, constant term first
};

/// What comes back, in the tool's frame, not divided by the kernel's integral. For the energy law
/// `force` is the sum of slope * Phi, for blanch of weight * pressure * unit gradient, and `torque`
/// that of q x the same (a ball has none under the energy law).
struct LatticeSums {
  double samples = 0.0;
  double law = 0.0;           ///< weight * law
  double law_rate = 0.0;      ///< weight * how fast the force grows with depth
  double force_even[3] = {};  ///< nodes with even i + j + k, and the others: each half is a lattice
  double force_odd[3] = {};
  double torque[3] = {};
  double drag = 0.0;           ///< weight * u
  double drag_first[3] = {};   ///< times q
  double drag_second[6] = {};  ///< times xx, yy, zz, yz, zx, xy
};

namespace baseline {
void sum_lattice(const LatticeJob& job, LatticeSums& sums) noexcept;
}
namespace avx2 {
void sum_lattice(const LatticeJob& job, LatticeSums& sums) noexcept;
}
namespace avx512 {
void sum_lattice(const LatticeJob& job, LatticeSums& sums) noexcept;
}

}  // namespace argil::haptics
