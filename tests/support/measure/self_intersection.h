// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <ostream>

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// Faults of the positions of a mesh, found by CGAL with exact predicates.
struct SoupFaults {
  std::size_t crossing_pairs = 0;  ///< triangles that meet in more than the vertices they share
  std::size_t refused = 0;         ///< triangles CGAL will not take: not a two-manifold there
  std::size_t degenerate = 0;      ///< triangles whose corners are collinear or coincide
  friend bool operator==(const SoupFaults&, const SoupFaults&) = default;
};

inline std::ostream& operator<<(std::ostream& out, const SoupFaults& f) {
  return out << "{crossing " << f.crossing_pairs << ", refused " << f.refused << ", degenerate "
             << f.degenerate << "}";
}

SoupFaults find_soup_faults(const TriangleMesh& mesh);

/// The mesh as a file of 32-bit floats would hold it, after moving it by `offset_mm`: the farther
/// from the origin, the coarser the floats.
TriangleMesh rounded_to_float(const TriangleMesh& mesh, const Vec3& offset_mm = {});

}  // namespace argil::test
