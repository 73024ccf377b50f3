// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Leaves out walls that stand across the inside of a solid, with one triangle at each edge of
/// their rim where the solid's surface has two, and matter all round: most programs that make such
/// walls mean no more than the solid. Returns how many triangles went.
///
/// Determinism  same bits every time.
/// Threads      one.
/// Cost         the edges; where there are such walls, also a winding number for each.
std::int64_t drop_inner_walls(TriangleMesh& mesh);

}  // namespace argil::mesh
