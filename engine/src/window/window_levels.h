// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// The levels that a window is read from.
struct LevelChoice {
  int level = 0;
  int finer_level = 0;          ///< level - 1, or == level when nothing is blended
  double finer_fraction = 0.0;  ///< 0 to 1
};

/// The level L with h_L <= voxel < 2 h_L, but no finer than level 0 and no coarser than
/// `coarsest_level`. Within a quarter octave above h_L the next finer level is blended in, linearly
/// in log2(voxel) from fraction 1 at h_L down to 0, so that a tool that grows never feels the
/// change.
LevelChoice choose_level(double voxel_mm, double finest_voxel_mm, int coarsest_level) noexcept;

}  // namespace argil
