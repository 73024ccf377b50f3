// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/field_window.h"
#include "argil/haptics/tool_force.h"

namespace argil::haptics {

/// The spacing of the window that a tool wants, and what a query on it costs.
struct Lattice {
  double voxel_mm = 0.0;
  int samples = 0;      ///< nodes under the kernel, within a few percent
  double across = 0.0;  ///< nodes across the smallest diameter
};

/// Most samples of a query that the servo makes, and most bytes of a window: see kWindowCapacity.
inline constexpr int kMostSamples = 4608;

/// 8 nodes across the tool's smallest diameter; fewer, but at least 4, for tools so long or flat
/// that this would be more than kMostSamples.
Lattice choose_lattice(const ForceTool& tool) noexcept;

/// Half side in mm of the window that a tool needs on this lattice, whatever way it turns, when its
/// centre may move by `margin_mm` before the next window comes.
double window_reach_mm(const ForceTool& tool, const Lattice& lattice, double margin_mm) noexcept;

/// How deep that window must know distance: 2 R + skin, and what the law's filter adds.
double window_depth_mm(const ForceTool& tool, const ForceMaterial& material,
                       const Lattice& lattice) noexcept;

/// Instruction sets a query can run on. All give the same bits.
enum class Simd { baseline, avx2, avx512 };

/// The best set of this machine.
Simd best_simd() noexcept;

/// The volume force in fixed time: one tool shape, one material, one law and one lattice spacing,
/// with everything worked out that does not depend on the pose.
///
/// The sum runs over the window's own nodes under the kernel. The law is applied to the stored
/// distance last, filtered to what the lattice can carry (a cubic convolution over four voxels with
/// vanishing second moment), so that the edge of a shallow contact and the clamp, both thinner than
/// a voxel, are summed without aliasing.
///
/// Accuracy against the integral over the exact distance: see docs/force.md and docs/charts.
///          `error_n` of the result bounds the error in 99 % of the cases of the chart.
/// Threads  Realtime: `evaluate` is noexcept, does not allocate, lock or call the system.
///          Constructing does not allocate either and takes about 50 us.
/// Cost     about 1.5 us for a ball of 8 nodes across with AVX-512 (bench force_lattice).
class LatticeForce {
 public:
  LatticeForce() noexcept;
  /// Only the shape and the radii of `tool` count.
  LatticeForce(const ForceTool& tool, const ForceMaterial& material, ForceLaw law, double voxel_mm,
               Simd simd = best_simd()) noexcept;

  /// Force and torque of the tool at its place and with its velocities; shape and radii must be
  /// those of the constructor, and the window's spacing too (else all is zero and outside_window).
  ForceResult evaluate(const FieldWindowView& window, const ForceTool& tool) const noexcept;
};

}  // namespace argil::haptics
