// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Makes parts that overlap, or lie in one another without a cavity between, one solid: triangles
/// where they meet are cut along each other, those inside go, all others stay as they are. All
/// parts must be closed and face outward. With cavities in the mesh only what overlaps is united.
///
/// Returns how many parts went into others; 0, and the mesh is as it was, where none did or where
/// what they would become is not a surface.
/// Source   CGAL's corefinement: S. Loriot et al., "Polygon mesh processing", CGAL manual.
std::int64_t unite_parts(TriangleMesh& mesh);

}  // namespace argil::mesh
