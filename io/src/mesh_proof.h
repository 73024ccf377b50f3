// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "pace.h"

namespace argil::io {

// Questions about a mesh that only exact arithmetic answers. All coordinates must be finite.

/// Triangles whose corners lie on one line, or that name a vertex twice; ascending.
std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh);

/// Pairs of triangles that meet elsewhere than in the vertices or the edge they share by index;
/// lower number first, sorted. Triangles in `left_out` (sorted) are not looked at, nor are pairs
/// with all three vertices in common. At most kMostCrossings (mesh_check.h); so many mean that
/// there may be more. Throws Interrupted. Cost     about 1 us per triangle when there are few
/// pairs; 12 bytes a triangle, and 80 for each
///          of those in the few slabs that are looked at at a time. 0.2 us for each pair whose
///          boxes overlap, crossing or not: long triangles that lie askew are slow.
/// Threads  slabs spread over TBB; same pairs for any number of threads.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const TriangleMesh& mesh, const std::vector<std::uint32_t>& left_out, const Pace& pace);
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const TriangleMesh& mesh, const std::vector<std::uint32_t>& left_out);

/// Whether the parts of a closed, two-manifold mesh without self-intersections are turned so that
/// outside and inside alternate: outer shells outward, cavities in them inward, and so on.
bool bounds_a_volume(const TriangleMesh& mesh);

/// Of such a mesh, which triangles would have to be turned for that; with all of a part.
std::vector<bool> wrongly_turned(const TriangleMesh& mesh);

}  // namespace argil::io
