// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// One thing wrong with a mesh and where.
struct MeshProblem {
  std::string kind;  ///< "boundary_edge", "nonmanifold_edge", "self_intersection", ...
  Vec3 at_mm;
  double size_mm = 0.0;
};

/// What a print service would ask. Counts are over the whole mesh.
struct MeshVerdict {
  bool printable = false;  ///< closed, manifold, outward, no self-intersection, nothing degenerate
  bool closed = false;
  bool manifold = false;
  bool outward = false;
  std::int64_t boundary_edges = 0;
  std::int64_t nonmanifold_edges = 0;
  std::int64_t nonmanifold_vertices = 0;
  std::int64_t self_intersections = 0;  ///< pairs of triangles, exact predicates
  std::int64_t degenerate = 0;          ///< triangles with a repeated vertex or no area
  std::int64_t duplicate = 0;           ///< triangles that repeat another's three vertices
  std::int64_t components = 0;
  std::int64_t euler = 0;
  double volume_mm3 = 0.0;
  double area_mm2 = 0.0;
  double min_wall_mm = -1.0;  ///< thinnest wall seen along inward rays; -1: not asked for
  std::vector<MeshProblem> problems;  ///< at most 100 of each kind, in the order of the triangles
};

/// Judges a mesh as given, by index: nothing is welded, moved or repaired on the way.
/// min_wall_mm > 0 also measures walls and reports those thinner (kind "thin_wall").
/// Accuracy  self-intersection and degeneracy by CGAL's exact predicates on the given coordinates.
/// Cost      about 1.1 us per triangle (bench `check`).
MeshVerdict check_mesh(const TriangleMesh& mesh_mm, double min_wall_mm = 0.0);

}  // namespace argil::io
