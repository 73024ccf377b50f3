// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil::test {

/// A ball with bumps half a voxel high and ten wide, which keep the finest level everywhere: a
/// smooth ball would be stored, and shown, at a coarser one. The radius of edges is that of
/// ClayOptions. For benchmarks.
Result<Clay> bumpy_ball(double radius_mm, double voxel_mm,
                        std::optional<double> edge_radius_mm = {}, const Vec3& center = {});

}  // namespace argil::test
