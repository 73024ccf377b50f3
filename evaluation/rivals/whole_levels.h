// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

#include "scene/distance.h"

namespace argil::evaluation {

/// Clay that is not adaptive: what adaptive clay is measured against, and a field whose values are
/// known. It breaks the invariant that a leaf is needed, so it is for reading only.

/// One level with the body's exact distance in every leaf that its band touches, and the sign
/// beyond. The body lies within `bounds_mm`; its distance is exact (a leaf is left out when it
/// says that no surface is near).
Clay uniform_clay(const Distance& distance, const Box3& bounds_mm, double voxel_mm);

/// The same clay with every leaf that the surface's band touches at every level down to the finest:
/// where the clay has no leaf, the interpolated values that it stands for.
Clay with_whole_levels(const Clay& clay);

/// Bytes of a level's leaves alone, without the tree above them.
std::int64_t leaf_bytes(const Clay& clay, int level);

}  // namespace argil::evaluation
