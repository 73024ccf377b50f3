// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The largest distance of any of the points from the triangles of a mesh, in mm; 0 for no points.
/// Cost  some microseconds a point, spread over TBB.
double farthest_from(const TriangleMesh& mesh, const std::vector<Vec3>& points);

}  // namespace argil::io
