// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

struct CloseReport {
  std::int64_t welded_vertices = 0;    ///< positions with equal bits merged
  std::int64_t joined_vertices = 0;    ///< of rims that nearly met all round, given one position
  std::int64_t dropped_triangles = 0;  ///< degenerate or duplicate
  std::int64_t boundary_edges = 0;     ///< before closing
  std::int64_t holes_closed = 0;       ///< boundary loops filled with triangles
  std::int64_t holes_left = 0;         ///< loops that could not be filled (pinched or crossing)
  std::int64_t turned_triangles = 0;   ///< that faced against most of their part
  std::int64_t parts = 0;              ///< connected parts
  std::int64_t parts_flipped = 0;      ///< parts turned so that they face outward
  std::int64_t nonmanifold_edges = 0;  ///< of the input after welding
  bool closed = false;                 ///< every part is closed and oriented now
};

struct ClosedMesh {
  TriangleMesh mesh;
  /// So many of its triangles, the first, were given; the others fill holes.
  std::size_t given_triangles = 0;
  CloseReport report;
};

/// Makes a mesh ready for import: welds, also rims that nearly meet where that closes it, orients
/// each connected part consistently, fills the holes that can be filled, and turns parts outward.
///
/// A part whose loops are not real holes (patches that overlap their neighbours instead of meeting
/// them) stays open when filling would need a patch larger than the part itself; the importer
/// bridges those by winding number. An inner shell that is closed and nested within another part
/// keeps its own orientation.
///
/// Shapes       any triangle soup with finite positions; normals are left out.
/// Returns      a mesh without triangles of no area and without vertices that none of them names.
/// Errors       bad_input when nothing remains (no triangles, all degenerate); memory;
///              interrupted when progress asked: heard between stages and between holes.
/// Determinism  same bits every time; nothing runs at once.
/// Threads      any thread.
/// Cost         n log n in the triangles; a hole goes with the cube of its rim up to 400 edges,
///              beyond that with a smaller search (bench_closing).
/// Source       holes: P. Liepa, "Filling holes in meshes", 2003, as CGAL has it: triangulated,
///              refined and faired, so that the patch continues the curvature of its rim.
Result<ClosedMesh> close_mesh(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace argil::mesh
