// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/window.h"

#include "scene/distance.h"

namespace argil::evaluation {

/// A window filled from a formula: nodes at multiples of `voxel_mm`, covering at least `reach_mm`
/// to every side of `center_mm`. `voxel_mm` above 0, `reach_mm` at least 0.
FieldWindow analytic_window(const Distance& distance_mm, const Vec3& center_mm, double reach_mm,
                            double voxel_mm);

}  // namespace argil::evaluation
