// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/field_window.h"
#include "argil/core/simd.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::haptics {

struct LatticeJob;   // private to haptics
struct LatticeSums;  // private to haptics

/// The spacing of the window that a tool wants, and what a query on it costs.
struct Lattice {
  /// Between nodes, > 0.
  double voxel_mm = 0.0;
  /// Nodes under the kernel, within a few percent.
  double samples = 0.0;
  /// Nodes across the smallest diameter.
  double across = 0.0;
};

/// Most samples of a query that the servo makes.
inline constexpr double kMostSamples = 1728.0;

/// The lattice of a tool: 8 nodes across its smallest diameter; fewer for tools so long or flat
/// that this would be more than kMostSamples. A kernel of fewer than 4 across is not resolved:
/// radii in a ratio of more than about 7 (long) or 3 (flat).
Lattice choose_lattice(const ForceTool& tool) noexcept;

/// How far a hand that rests may move a tool before the next window comes, mm: its diameter, 1 to
/// 4. Small tools have fine windows, each mm of which costs much; none starts off so fast that it
/// moves farther in the 20 ms that a window takes.
double resting_margin_mm(const ForceTool& tool) noexcept;

/// Half side of the window that a tool needs on this lattice, whichever way it turns.
///
/// Units  margin_mm: how far its centre may move before the next window comes, >= 0. Result in mm.
double window_reach_mm(const ForceTool& tool, const Lattice& lattice, double margin_mm) noexcept;

/// How deep that window must know the distance for a centre up to 2 R below the surface: 3.61 R +
/// skin, and what the law's filter adds. With less the force falls inside the clay instead of
/// growing (docs/theory.md, "Why the window is deep").
double window_depth_mm(const ForceTool& tool, const ForceMaterial& material,
                       const Lattice& lattice) noexcept;

/// The volume force in fixed time: one tool shape, one material, one law and one lattice spacing,
/// with everything worked out that does not depend on the pose.
///
/// Sums over the window's own nodes under the kernel, the law applied to the stored distance last
/// and filtered to what the lattice can carry, so that the edge of a shallow contact and the clamp,
/// which may be thinner than a voxel, are summed without aliasing. For the energy law the force is
/// minus the gradient of the summed energy to rounding: no work is gained on a closed path.
///
/// Accuracy against the closed form on a plane and on a ball within 0.8 % at every depth, skins of
///          R / 4 to 4 R (LatticeForce.*); on clay p95 1 % on smooth matter, 3 % at edges, slots
///          and bumps (docs/charts). `error_n` bounds the error of 99 % of the chart's poses.
/// Threads  Realtime: noexcept, no allocation, no lock, no system call; constructing included.
/// Cost     a query of a ball 3.5 us with AVX-512, 5 with AVX2, 8 with neither, whatever its
///          radius; other shapes up to 7 us (bench force_query). Constructing 5 us, 25 when the
///          exponent is not whole.
/// Source   docs/forces.md, "In fixed time".
class LatticeForce {
 public:
  /// Cubic pieces of the law's table.
  static constexpr std::size_t kSegments = 32;

  /// `tool`: only its shape and radii count. `voxel_mm`: > 0, of the windows to come. `simd`: one
  /// that this machine has.
  LatticeForce(const ForceTool& tool, const ForceMaterial& material, ForceLaw law, double voxel_mm,
               Simd simd = best_simd()) noexcept;

  /// Force and torque of the tool at its position and with its velocities. All is zero and
  /// `outside_window` is set where the spacing of the window is not that of the constructor, or so
  /// fine that the sum would take more than kMostSamples (a capsule: up to twice as many, since it
  /// visits the box around it).
  ForceResult evaluate(const FieldWindowView& window, const ForceTool& pose) const noexcept;

  double voxel_mm() const noexcept { return voxel_mm_; }

 private:
  using Table = std::array<std::array<float, kSegments>, 4>;

  void fill_job(const FieldWindowView& window, const Vec3& center, const std::array<Vec3, 3>& axes,
                double offset, LatticeJob& job) const noexcept;
  void apply_contact(const LatticeSums& sums, const std::array<Vec3, 3>& axes, double offset,
                     double distance_error_mm, ForceResult& result) const noexcept;
  void apply_drag(const LatticeSums& sums, const std::array<Vec3, 3>& axes, const ForceTool& pose,
                  ForceResult& result) const noexcept;

  ForceTool shape_;
  ForceMaterial material_;
  ForceLaw law_;
  Simd simd_;
  double voxel_mm_;
  Vec3 reach_mm_;
  double segment_mm_;
  double weight_sum_;  ///< integral of the kernel in voxels
  bool is_bounded_;    ///< not more samples than the budget
  double table_low_mm_;
  double table_per_mm_;
  Table table_;
};

}  // namespace argil::haptics
