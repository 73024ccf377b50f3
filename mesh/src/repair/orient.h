// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

inline void turn_over(Triangle& t) noexcept { std::swap(t[1], t[2]); }

/// Turns the triangles of each part alike, as most of them face already. Returns how many.
///
/// Shapes  edges, parts: the table of that very mesh and its parts, cut at edges of three
/// triangles. Cost    linear.
std::int64_t orient_alike(TriangleMesh& mesh, const EdgeTable& edges, const MeshParts& parts);

}  // namespace argil::mesh
