// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/check.h"
#include "argil/mesh/close.h"
#include "argil/mesh/thickening.h"

namespace argil::mesh {

struct MendReport {
  bool is_changed = false;  ///< false: it was printable as it came
  CloseReport closing;
  std::int64_t joined_vertices = 0;  ///< at one point, or rims closer than 1e-6 of the diagonal
  std::int64_t split_edges = 0;      ///< at T-junctions
  std::int64_t interior_faces = 0;   ///< triangles dropped that solids had in common
  std::int64_t dropped_fins = 0;     ///< triangles that stand on a closed surface
  std::int64_t coned_holes = 0;      ///< that touched or crossed: closed by cones, where w decides
  std::int64_t dropped_sheets = 0;   ///< open parts beside solids that enclose nothing
  std::int64_t dropped_crumbs = 0;   ///< flat, cut off by mending: less than 1e-6 of the volume
  std::int64_t thickened_sheets = 0;
  std::int64_t parted_vertices = 0;  ///< where surfaces only touched: drawn apart by `gap_mm`
  double gap_mm = 0.0;
  std::int64_t united_parts = 0;  ///< overlapping or nested parts that became one
  std::int64_t crossings = 0;     ///< pairs of triangles that crossed before
  MeshVerdict verdict;            ///< of the result
};

struct MendedMesh {
  TriangleMesh mesh;
  /// The given triangles, joined along their rims and turned to face as those of `mesh` do, without
  /// what was added to close them: their winding number is what was given of an inside. Empty where
  /// nothing changed.
  TriangleMesh facing;
  MendReport report;
};

/// Mends a mesh by changes to where it is broken alone: welds, joins rims, splits edges at
/// T-junctions, drops fins, inner walls, loose sheets and faces in common, gives sheets the
/// thickness that is asked for, fills holes, turns parts outward, cuts what crosses or overlaps and
/// keeps what bounds its inside, draws apart what only touches. Whether that was enough the verdict
/// says; where it was not, `io::repair_mesh` makes the mesh anew through a level set.
///
/// Shapes       any triangle soup, in mm. Coordinates are rounded to float first, so that what is
///              judged is what a file holds; normals are left out.
/// Returns      the mesh as it is, rounded, where it was printable.
/// Errors       bad_input: a thickness that is negative or not finite; no triangle with an area, a
///              vertex that is missing, not finite or beyond what a float holds; open sheets and
///              nothing else, without a thickness; memory; interrupted.
/// Accuracy     rims move by at most 1e-6 of the diagonal, up to 1e-3 where that closes them and
///              1e-4 at T-junctions; touching surfaces by `gap_mm` (MeshRepair.*); crossings by the
///              rounding to float (ResolveCrossings.*).
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         the checks, 2 us a triangle for each of up to a dozen; crossings 50 us a pair.
Result<MendedMesh> mend_mesh(const TriangleMesh& mesh_mm, const Thickening& thickening = {},
                             const Progress& progress = {});

}  // namespace argil::mesh
