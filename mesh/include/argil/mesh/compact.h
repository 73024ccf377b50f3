// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

// Copies of a mesh with fewer vertices or triangles. Every triangle must name vertices that exist;
// normals are left out. All are linear in the mesh; any thread.

/// The box of what triangles name; other vertices are nowhere on the mesh. Empty without triangles.
Box3 used_bounds(const TriangleMesh& mesh) noexcept;

/// The same triangles in the same order, without vertices that none of them names. Vertices keep
/// their order too, so that where nothing is left out all numbers stay.
TriangleMesh compacted(const TriangleMesh& mesh);

/// The same triangles in the same order on one vertex for each position (PointWelder), in the order
/// in which positions first occur. Triangles that name a vertex twice by that are kept: EdgeTable
/// passes over them, and close_mesh leaves them out.
TriangleMesh welded(const TriangleMesh& mesh);

/// The triangles for which `is_wanted(number)`, in order, on the vertices they name in the order in
/// which they first do. `is_wanted` is asked once for each, in ascending order.
template <class IsWanted>
TriangleMesh only_triangles(const TriangleMesh& mesh, const IsWanted& is_wanted) {
  constexpr std::uint32_t kUnnumbered = std::numeric_limits<std::uint32_t>::max();
  TriangleMesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnnumbered);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!is_wanted(i)) continue;
    Triangle t = mesh.triangles[i];
    for (std::uint32_t& v : t) {
      if (number[v] == kUnnumbered) {
        number[v] = static_cast<std::uint32_t>(kept.positions.size());
        kept.positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    kept.triangles.push_back(t);
  }
  return kept;
}

}  // namespace argil::mesh
