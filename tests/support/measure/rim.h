// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

#include "measure/rim_measure.h"

namespace argil::test {

using evaluation::measure_rim;
using evaluation::RimCase;
using evaluation::RimMeasure;

/// What rims are made on: a ball with voxels so fine that tools up to 16 mm have finer levels.
inline constexpr double kRimBall = 40.0;
inline constexpr double kRimVoxel = 0.25;
Clay rim_ball(std::optional<double> edge_radius_mm);

/// Three directions that no lattice favours, one of them nearly along an axis.
const std::vector<Vec3>& rim_directions();

/// Three kinds of rim, 58 to 96 degrees, in each direction. With a tool 8 voxels wide, where rims
/// are worst, nine cases that figures are about.
std::vector<RimCase> nine_rims(double tool_mm);
Stroke dab_of(const RimCase& rim);

/// rms of how much two rims differ, angle by angle.
double rms_between(const RimMeasure& a, const RimMeasure& b);

}  // namespace argil::test
