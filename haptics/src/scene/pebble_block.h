// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene_pebbles.h"

namespace argil::haptics {

/// Columns and rows of the grid, first to last, whose spheres a handle may touch; none when last <
/// first.
struct PebbleBlock {
  int first_column = 0;
  int last_column = -1;
  int first_row = 0;
  int last_row = -1;

  /// How many spheres these are: 0 to PebblesScene::kMostCandidates.
  int count() const noexcept {
    return std::max(last_column - first_column + 1, 0) * std::max(last_row - first_row + 1, 0);
  }
};

/// The sphere nearest to a position and its neighbours, by the cell of the grid: a few operations,
/// whatever the size of the grid. Empty out of reach, and for NaN.
PebbleBlock pebble_block(const PebblesOptions& options, const Vec3& position_mm) noexcept;

}  // namespace argil::haptics
