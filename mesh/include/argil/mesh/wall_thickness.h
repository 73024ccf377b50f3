// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// How thick the solid is under the middle of each triangle, in mm: along the inward normal to the
/// first triangle that faces the other way. Infinite where there is none, and for triangles without
/// area.
///
/// Accuracy     single precision about the middle of the mesh: 1e-7 of its extent
///              (WallThickness.*).
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         two rays in Embree, about 0.5 us per triangle.
std::vector<double> wall_thickness_mm(const TriangleMesh& mesh);

/// What measures walls for a check: the triangles, as above, or the field of the clay that they
/// were extracted from. One thickness in mm for each triangle.
using WallMeasure = std::function<std::vector<double>(const TriangleMesh&)>;

}  // namespace argil::mesh
