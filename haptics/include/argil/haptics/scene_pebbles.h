// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

/// The report gives no numbers for its pebbles: these are ours, bumps 1.1 mm high. Neighbours
/// overlap by so much that a handle slips between them only when it is pressed with more than 3.5 N
/// (Equation3_15.CarriesALightHand).
struct PebblesOptions {
  Vec3 center_mm{0.0, 0.0, -20.0};  ///< the middle of the grid, which lies across z; usual z = -20
  int columns = 21;                 ///< spheres along x; usual 21; 1 to 100 000
  int rows = 21;                    ///< spheres along y; usual 21; 1 to 100 000
  double spacing_mm = 5.0;          ///< between neighbours; usual 5; > 0
  double radius_mm = 6.0;           ///< r; usual 6; > 0 to 1.5 spacings, so that 9 are enough
  double stiffness_n_per_m = 1000.0;  ///< k of each; usual 1000; several add up where they overlap
  double damping_n_s_per_m = 5.0;     ///< c of each; usual 5; 0 to 20
};

/// A bed of equal spheres, equations 3.15 and 3.18: each pushes along the line from its middle, and
/// what overlaps is summed.
///
/// The spheres are found by the cell of the grid that the handle is in, never by a search. Behind
/// the middles the spheres push on downwards: there is no wall behind them.
///
/// Cost  at most kMostCandidates spheres, whatever the size of the grid:
///       Equation3_15.LooksAtAsManySpheresInAnyGrid.
class PebblesScene final : public ForceScene {
 public:
  static constexpr int kMostCandidates = 9;

  explicit PebblesScene(const PebblesOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& place) const noexcept override;

  /// How many spheres force_at looks at for a place.
  int candidates_at(const Vec3& position_mm) const noexcept;

  /// The middle of a sphere; column from 0 to columns - 1, row from 0 to rows - 1.
  Vec3 sphere_center_mm(int column, int row) const noexcept;

 private:
  /// Columns and rows, first to last, that may be touched; none when last < first.
  struct Block {
    int first_column = 0;
    int last_column = -1;
    int first_row = 0;
    int last_row = -1;
  };
  Block block_at(const Vec3& position_mm) const noexcept;

  PebblesOptions options_;
};

}  // namespace argil::haptics
