// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

/// A grid of spheres. The Falcon report gives no numbers for its pebbles: these are ours, bumps
/// 1.1 mm high. Neighbours overlap by so much that a handle slips between them only when it is
/// pressed with more than 3.5 N (Equation3_15.CarriesALightHand).
struct PebblesOptions {
  /// The middle of the grid, which lies across z; usual z = -20.
  Vec3 center_mm{0.0, 0.0, -20.0};
  /// Spheres along x; usual 21, 1 to 100 000.
  int columns = 21;
  /// Spheres along y; usual 21, 1 to 100 000.
  int rows = 21;
  /// Between the middles of neighbours; usual 5, > 0.
  double spacing_mm = 5.0;
  /// r of each; usual 6, > 0 to 1.5 spacings: a larger one would touch more than 9 at once.
  double radius_mm = 6.0;
  /// k of each; usual 1000, >= 0. Where spheres overlap theirs add up.
  double stiffness_n_per_m = 1000.0;
  /// c of each; usual 5, 0 to 20; more buzzes with a measured velocity.
  double damping_n_s_per_m = 5.0;
};

/// A bed of equal spheres: each pushes along the line from its middle, and forces of spheres that
/// overlap are summed.
///
/// The spheres are found by the cell of the grid that the handle is in, never by a search. Behind
/// the middles the spheres push on downwards: there is no wall behind them.
///
/// Threads  as ForceScene.
/// Cost     at most kMostCandidates spheres, whatever the size of the grid
///          (Equation3_15.LooksAtAsManySpheresInAnyGrid).
/// Source   equations 3.15 and 3.18 of the Falcon report (docs/equations.md).
class PebblesScene final : public ForceScene {
 public:
  /// The sphere nearest to the handle and its eight neighbours.
  static constexpr int kMostCandidates = 9;

  explicit PebblesScene(const PebblesOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

  /// The middle of a sphere; column from 0 to columns - 1, row from 0 to rows - 1.
  Vec3 sphere_center_mm(int column, int row) const noexcept;

 private:
  PebblesOptions options_;
};

}  // namespace argil::haptics
