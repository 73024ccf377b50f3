// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "level_block.h"

namespace argil {

/// `box` of `level`, which may be negative, with the field's own value near the surface and,
/// farther than the finest band minus one voxel, the distance to the closest place of the clay's
/// surface: the reference that faster extensions are measured against. Slow: it extracts the whole
/// surface.
LevelBlock exact_block(const Clay& clay, int level, const NodeBox& box);

}  // namespace argil
