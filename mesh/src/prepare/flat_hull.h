// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"

namespace argil::mesh {

/// The convex hull of points seen along z, counter-clockwise without points on its edges; one or
/// two points where all lie in a point or on a line. z is kept and not looked at.
/// Source  A. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
std::vector<Vec3> flat_hull(std::vector<Vec3> points);

/// How far a point lies within a hull, seen along z: to the nearest edge, negative outside of it
/// (there to the line through the edge that it is farthest beyond). The lowest number for a hull
/// without area.
double depth_within(const std::vector<Vec3>& hull, const Vec3& point);

}  // namespace argil::mesh
