// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field/vdb.h"
#include "support/force_scenes.h"

namespace argil::test {

/// Level 0 of a scene as an import makes it: distances in mm clamped to the band, every leaf with a
/// node in it, inside tiles flood-filled; what `stack_from_finest` takes.
VdbGrid::Ptr complete_level(const ForceScene& scene, double voxel_mm);

}  // namespace argil::test
