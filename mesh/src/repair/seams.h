// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

// Mends of a triangle soup that need nothing but its indices and lengths. Triangles that are not
// concerned keep their corners, bit for bit, and their order.

/// Leaves out triangles that name a vertex twice, or the three of another before them, whichever
/// way round. Returns how many.
std::int64_t drop_repeated(TriangleMesh& mesh);

/// Leaves out the faces that solids side by side have in common, so that they are one solid: pairs
/// of triangles with the same corners, facing each other, in walls that end all round in edges of
/// two more triangles. Sheets and bodies that are there both ways round stay. Returns how many
/// triangles went. To be called before drop_repeated, which keeps one of each pair.
std::int64_t drop_interior_faces(TriangleMesh& mesh);

/// Gives vertices of open edges that are nearer than `near_mm` one position and number. Returns how
/// many went.
std::int64_t join_rims(TriangleMesh& mesh, double near_mm);

/// How many edges have one triangle.
std::int64_t open_edges(const TriangleMesh& mesh);

/// Of the diagonal of what triangles name: rims that are so near are meant to be one, and so they
/// may be up to the other where that closes them.
inline constexpr double kNearRims = 1e-6;
inline constexpr double kFarRims = 1e-3;

/// How rims were joined; nothing where they were not.
struct RimsJoined {
  std::int64_t vertices = 0;  ///< that went
  double near_mm = 0.0;
};

/// join_rims with the least distance, in steps of 4, that closes nine of ten open edges, where
/// there is one: triangles whose corners were each rounded or measured by themselves. Else the mesh
/// is as it was. Not beyond a quarter of what is short among open edges.
RimsJoined join_rims_as_needed(TriangleMesh& mesh, double least_mm, double most_mm);

/// Splits open edges at vertices of others that lie on them, within `near_mm`. Returns how many
/// edges were split. A triangle is split along one edge a time, so call until it returns 0.
std::int64_t split_at_rims(TriangleMesh& mesh, double near_mm);

/// Leaves out fins: open sheets that stand with one triangle an edge on a part of more than twice
/// their area. Returns how many triangles went.
std::int64_t drop_fins(TriangleMesh& mesh);

/// Where surfaces only touch, in a vertex or along an edge, gives each its own vertices and draws
/// these `gap_mm` into its solid. Triangles must face outward. Returns how many vertices were
/// added; -1, and the mesh is as it was, where the triangles at an edge do not bound solids.
std::int64_t part_touching(TriangleMesh& mesh, double gap_mm);

}  // namespace argil::mesh
