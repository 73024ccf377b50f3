// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Leaves out walls that stand across the inside of a shell, of a solid or of a cavity, with one
/// triangle at each edge of their rim where the shell has two: most programs that make such walls
/// mean no more than the shell. Not where walls are so many that asking would take long. Returns
/// how many triangles went.
///
/// Errors       throws Interrupted where `pace` asks.
/// Determinism  same bits every time.
/// Threads      one.
/// Cost         the edges; where there are n walls, also n^2 winding numbers, 2 s at most.
std::int64_t drop_inner_walls(TriangleMesh& mesh, const Pace& pace);

}  // namespace argil::mesh
