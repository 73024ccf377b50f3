// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// Mends what rounding to float folded: in every triangle without area and every pair of triangles
/// that cross, the shortest edge shrinks to one of its ends, where that keeps the surface
/// two-manifold. Returns how many edges went; 0 leaves the mesh as it is. One round: what this
/// uncovers is for the next call. Meant for a handful of slivers in a closed, two-manifold mesh.
std::int64_t collapse_folded(TriangleMesh& mesh);

}  // namespace argil::io
