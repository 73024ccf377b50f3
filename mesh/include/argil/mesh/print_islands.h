// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Solid that begins in mid-air, z up: nothing is below it, and it hangs on nothing yet.
struct PrintIsland {
  Vec3 at_mm;             ///< its lowest point
  double area_mm2 = 0.0;  ///< of its first whole layer
  /// From there to where it meets solid that began lower; infinite for a part of its own.
  double free_mm = 0.0;
};

/// All islands of a piece that stands with its lowest point on the bed, lowest first: each local
/// minimum of the height, but for those on the bed (the lowest kOnBedMm), those that are minima of
/// the air (the floor of a hollow), and bumps that meet others within a layer, which no slicer
/// sees. Found by growing the surface up from its minima, not by layers: none falls between two.
///
/// Shapes       closed, outward, two-manifold. No triangles: no islands.
/// Units        layer_mm > 0.
/// Determinism  same list every time; of points at one height the lower vertex counts as lower.
/// Errors       throws std::bad_alloc: to be called within no_throw.
/// Threads      any. Cost  n log n; 0.4 us for each triangle.
/// Source       the merge tree of the height: H. Carr, J. Snoeyink, U. Axen, "Computing contour
///              trees in all dimensions", Computational Geometry 24 (2003).
std::vector<PrintIsland> print_islands(const TriangleMesh& mesh, double layer_mm);

}  // namespace argil::mesh
