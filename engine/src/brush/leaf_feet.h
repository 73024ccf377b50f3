// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "argil/core/vec3.h"

#include "field/leaf.h"
#include "rows/rows.h"

namespace argil {

/// The feet of one leaf: the nearest points of the surface, where the surface is moved.
struct LeafFeet {
  Vec3 origin_mm;         ///< of the leaf: what points count from
  double voxel_mm = 0.0;  ///< what points count in
  FeetBlock rows;         ///< with pulls: what the falloff and the mask leave there, 0 to 1

  /// Of the node with this offset in the leaf.
  Vec3 point_mm(std::size_t node) const noexcept {
    return origin_mm + voxel_mm * Vec3{static_cast<double>(rows.at.x[node]),
                                       static_cast<double>(rows.at.y[node]),
                                       static_cast<double>(rows.at.z[node])};
  }
};

/// What a law says of the nodes of a leaf, in mm; set in rows that are pulled.
struct LeafMoves {
  alignas(64) std::array<float, kLeafNodes> mm;
};

}  // namespace argil
