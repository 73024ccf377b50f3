// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/engine/clay.h"

#include "field/dense_block.h"

namespace argil {

/// The nodes `box` of the lattice of spacing `voxel_mm`, z fastest, with the field's own value near
/// the surface and, farther than the finest band minus one voxel, the distance to the closest point
/// of the clay's surface: the reference that faster extensions are measured against. Slow: it
/// extracts the whole surface.
void exact_distances(const Clay& clay, double voxel_mm, const NodeBox& box, std::span<float> out);

}  // namespace argil
