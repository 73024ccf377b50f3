// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil {

struct ImportReport {
  /// Nodes whose sign came from a winding number between 0.25 and 0.75: where the input did not say
  /// clearly what is inside (open gaps bridged by the half-winding membrane). 0 for closed input.
  std::int64_t bridged_nodes = 0;
  bool winding_bridged = false;  ///< the input was open, so gaps were closed by winding number
  /// Input vertices farther than one voxel from the clay's surface (tips and sheets thinner than
  /// two voxels, overlapped inner parts), and the farthest such distance in mm.
  std::int64_t lost_vertices = 0;
  double max_vertex_distance_mm = 0.0;  ///< saturates at the coarsest band where it lies there
};

struct ImportResult {
  Clay clay;
  ImportReport report;
};

/// A mesh in mm as clay: true distance to its triangles near the surface, sign by the generalized
/// winding number, so that overlapping closed parts become their union and gaps are bridged.
///
/// Shapes   any triangle soup with finite positions; consistently oriented outward per part.
/// Errors   bad_input  no triangles, zero extent, no volume inside, or beyond kMaxNode;
///          memory     the estimated need exceeds `memory_limit_bytes` (0: what the machine has
///                     free): refused before allocating, the message names the voxel size that
///                     fits;
///          interrupted by `progress`.
/// Accuracy distances from the triangles to 5e-6 voxel in the finest band, where no wall or gap is
///          near; signs exact for closed input, at nodes farther than 1e-3 voxel from it.
/// Cost     2 us of CPU for each vertex of the finest surface (docs/import.md).
/// Threads  as Clay. Same bits for any number of threads.
/// Source   A. Jacobson et al., "Robust inside-outside segmentation using generalized winding
///          numbers", 2013; G. Barill et al., "Fast winding numbers for soups and clouds", 2018.
Result<ImportResult> import_mesh(const TriangleMesh& mesh_mm, const ClayOptions& options,
                                 const Progress& progress = {},
                                 std::uint64_t memory_limit_bytes = 0);

}  // namespace argil
