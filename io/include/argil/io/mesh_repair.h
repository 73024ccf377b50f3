// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_check.h"
#include "argil/io/mesh_close.h"

namespace argil::io {

/// How far a repair had to go.
enum class RepairWay : std::uint8_t {
  nothing,  ///< it was printable
  local,    ///< welded, cut, turned, filled or parted where that was needed
  field     ///< made anew from a level set: no triangle is as it was
};

struct RepairOptions {
  /// Of the level set, where all else fails: > 0, or 0 for a 512th of the largest side.
  double voxel_mm = 0.0;
};

struct RepairReport {
  RepairWay way = RepairWay::nothing;
  CloseReport closing;
  std::int64_t joined_vertices = 0;  ///< at one place, or rims closer than 1e-6 of the diagonal
  std::int64_t split_edges = 0;      ///< at T-junctions
  std::int64_t dropped_fins = 0;     ///< triangles that stand on a closed surface
  std::int64_t parted_vertices = 0;  ///< where surfaces only touched: drawn apart by `gap_mm`
  double gap_mm = 0.0;
  std::int64_t united_parts = 0;    ///< overlapping or nested parts that became one
  std::int64_t crossings = 0;       ///< pairs of triangles that crossed before
  double voxel_mm = 0.0;            ///< of the level set; 0: none was needed
  std::int64_t kept_triangles = 0;  ///< of the input, with every bit of its corners
  double max_change_mm = 0.0;       ///< farthest vertex of the result from the input
  MeshVerdict verdict;              ///< of the result
};

struct RepairedMesh {
  TriangleMesh mesh;
  RepairReport report;
};

/// Makes a mesh printable by the least change that works: first the surface is mended where it is
/// broken, and only when that does not do is it made anew through a level set. Coordinates are
/// rounded to float first, so that what is judged is what a file holds.
///
/// Shapes   any triangle soup with finite positions, in mm.
/// Errors   bad_input: no triangle with an area, a coordinate that is not finite, or nothing inside
///          (an open sheet); memory: the level set would not fit, the message names the voxel that
///          does; interrupted.
/// Accuracy rims move by at most 1e-6 of the diagonal, touching surfaces by `gap_mm`; through the
///          field a voxel (MeshRepair*.*).
/// Threads  any thread; the field spreads over TBB. Same bits for any number of threads.
/// Cost     the checks, 2 us a triangle for each of up to six; crossings and the field more.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh_mm, const RepairOptions& options = {},
                                 const Progress& progress = {});

}  // namespace argil::io
