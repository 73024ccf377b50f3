// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "feet/layer_feet.h"

namespace argil {

/// Of the nodes of some leaves that lie near the surface: the sum of the squares of how far their
/// values may be off, in mm^2, and how many they are.
struct ErrorSum {
  double squares_mm2 = 0.0;
  int nodes = 0;

  ErrorSum& operator+=(const ErrorSum& other) noexcept {
    squares_mm2 += other.squares_mm2;
    nodes += other.nodes;
    return *this;
  }
};

/// Of a leaf of `level`, with `values` as read_with_faces() has them; nodes within 2.5 voxels of
/// the surface count.
///
/// Two parts, squares added. What averaging lost: the difference to the finest level that knows the
/// same node (0 where none does). What interpolating and the layers lose: kBend times the second
/// differences along the three axes, which tell kinks from curves.
ErrorSum leaf_error(LevelReader& reader, int level, const Coord& origin,
                    const LeafAndFaces& values);

/// How far a window of nodes of a level may be off near the surface, by its leaves: the root mean
/// square, with kFloor voxels, which are all that is said where nothing is near.
///
/// Accuracy within a factor of 2.5 of what is measured, where that is above 0.01 voxel and nodes
///          are interpolated (WindowError.FollowsWhatIsMeasured); where they are copied it says up
///          to five times too much. What the clay's tolerance dropped is part of the surface and
///          not counted.
double window_error_mm(const ErrorSum& sum, double voxel_mm) noexcept;

}  // namespace argil
