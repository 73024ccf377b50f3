// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// The bodies of a closed mesh: each an outer shell with the cavities in it,
/// but not what lies loose in a cavity.
struct MeshBodies {
  std::vector<std::uint32_t> of_triangle;  ///< body of each triangle
  std::uint32_t count = 0;                 ///< numbered by the volume of their shell, largest first
};

/// Which body each triangle belongs to.
///
/// Shapes       closed, finite; no triangle names a vertex twice. A component that is inside out
/// and
///              in no shell is a body of its own. No triangles: no bodies.
/// Determinism  same numbers every time.
/// Threads      any thread.
/// Cost         linear; where there are cavities also a winding number tree of the shells whose
///              boxes hold one.
MeshBodies mesh_bodies(const TriangleMesh& mesh);

/// One mesh for each number, of its triangles in their order with their own vertices.
///
/// Shapes       of_triangle: a number for each triangle, from 0 without gaps.
std::vector<TriangleMesh> split_mesh(const TriangleMesh& mesh,
                                     std::span<const std::uint32_t> of_triangle);

}  // namespace argil::mesh
