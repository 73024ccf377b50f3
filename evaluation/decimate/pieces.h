// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/engine/clay.h"

namespace argil::evaluation {

/// A ball whose waves, 24 voxels long and 1.5 high, keep detail everywhere.
Result<Clay> wavy_ball(double radius_voxels);

/// A block of sides 1.5 : 1.33 : 1 with its sharp edges, a groove and a dent with sharp rims, and a
/// bump: flat in most places.
Result<Clay> sculpted_block(double thickness_voxels);

}  // namespace argil::evaluation
