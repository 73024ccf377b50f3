// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The box of what triangles name; other vertices are nowhere on the mesh.
Box3 used_bounds(const TriangleMesh& mesh) noexcept;

/// The same triangles in the same order, without vertices that none of them names. No normals.
TriangleMesh compacted(const TriangleMesh& mesh);

/// The same triangles in the same order on one vertex for each place. No normals.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace argil::io
