// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The inside of a polygon as triangles that are turned as it is, by the constrained Delaunay
/// triangulation of what is seen along the axis nearest to its normal. A place is inside when an
/// odd number of edges lies between it and the outside, so that an edge which is gone along twice,
/// as on the way to a hole, bounds nothing. The triangles name corners by their number in
/// `corners`.
///
/// Empty   where the polygon has no inside of that kind: all corners on a line, or edges that
/// cross. Cost    n log n for n corners of usual shapes. Source  Boissonnat, Devillers, Pion,
/// Teillaud, Yvinec: Triangulations in CGAL (2002).
std::vector<Triangle> triangulated(std::span<const Vec3> corners);

}  // namespace argil::io
