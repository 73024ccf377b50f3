// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The bodies of a closed mesh that faces outward: each an outer shell with the cavities in it,
/// but not what lies loose in a cavity.
struct MeshBodies {
  std::vector<std::uint32_t> of_triangle;  ///< body of each triangle
  std::uint32_t count = 0;                 ///< numbered by the volume of their shell, largest first
};

/// No triangle may name a vertex twice.
/// Cost  linear; where a cavity may be in several shells also a winding number tree of each.
MeshBodies mesh_bodies(const TriangleMesh& mesh);

/// One mesh for each number, of its triangles in their order with their own vertices.
std::vector<TriangleMesh> split_mesh(const TriangleMesh& mesh,
                                     std::span<const std::uint32_t> of_triangle);

}  // namespace argil::io
