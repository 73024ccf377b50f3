// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// The levels that a window is read from.
struct LevelChoice {
  int level = 0;
  int finer_level = 0;       ///< level - 1, or == level when nothing is blended
  double finer_share = 0.0;  ///< 0 to 1
};

/// The level L with h_L <= voxel < 2 h_L, but no finer than level 0 and no coarser than
/// `coarsest_level`. In the last quarter octave below h_{L+1} that level is blended in, linearly in
/// log2(voxel), so that a tool that grows never feels the change. At voxel == h_L it is level L
/// alone: a window on the level's own nodes is a copy.
LevelChoice choose_level(double voxel_mm, double finest_voxel_mm, int coarsest_level) noexcept;

}  // namespace argil
