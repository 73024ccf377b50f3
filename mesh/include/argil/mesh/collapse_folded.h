// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/check.h"

namespace argil::mesh {

/// Mends what rounding to float folded: in every triangle without area and every pair of triangles
/// that cross, the shortest edge shrinks to one of its ends, where that keeps the surface
/// two-manifold, and is no longer than `longest_mm`. Meant for a handful of slivers in a closed,
/// two-manifold mesh. One round: what this uncovers is for the next call.
///
/// Returns      how many edges went; 0 leaves the mesh as it is. Otherwise vertices and triangles
///              are numbered anew, and normals are left out.
/// Errors       throws std::bad_alloc: to be called within no_throw.
/// Threads      any thread; spreads over TBB. Same bits for any number of threads.
/// Cost         degenerate_triangles and self_intersections once each.
std::int64_t collapse_folded(TriangleMesh& mesh,
                             double longest_mm = std::numeric_limits<double>::infinity());

/// Rounds of collapse_folded, at most four, until the mesh is printable or nothing more goes.
///
/// Returns      what check_mesh would say of it last.
/// Errors       throws Interrupted where `pace` asks to stop, and std::bad_alloc: to be called
///              within no_throw.
/// Threads      as collapse_folded; `pace` is told from the thread that calls.
MeshVerdict check_and_collapse_folded(TriangleMesh& mesh, double longest_mm, const Pace& pace);

}  // namespace argil::mesh
