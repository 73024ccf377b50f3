// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/level_stack.h"

namespace argil {

/// Whether a leaf of the mask may hold the surface or lies within 10 finest voxels of it: there
/// every node counts; elsewhere one value for the whole leaf does.
bool is_near_surface(const LevelStack& stack, const Coord& mask_origin);

}  // namespace argil
