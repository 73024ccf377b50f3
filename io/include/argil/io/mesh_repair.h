// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/repair.h"

namespace argil::io {

/// How far a repair had to go.
enum class RepairPath : std::uint8_t {
  nothing,  ///< it was printable
  local,    ///< welded, cut, turned, filled or parted where that was needed
  field     ///< rebuilt from a level set: no triangle is as it was
};

struct RepairOptions {
  /// Of the level set, where all else fails: > 0, or 0 for a 512th of the largest side, up to a
  /// 220th where that would put more than 220 000 voxels on the surface.
  double voxel_mm = 0.0;
};

/// What was mended; the verdict is of the result.
struct RepairReport : mesh::MendReport {
  RepairPath path = RepairPath::nothing;
  double voxel_mm = 0.0;            ///< of the level set; 0: none was needed
  std::int64_t kept_triangles = 0;  ///< of the input, with every bit of its corners
  double max_change_mm = 0.0;       ///< farthest vertex of the result from the input
};

struct RepairedMesh {
  TriangleMesh mesh;
  RepairReport report;
};

/// Makes a mesh printable by the least change that works: first the surface is mended where it is
/// broken (mesh::mend_mesh), and only when that does not do is it rebuilt through a level set.
///
/// Shapes       any triangle soup with finite positions, in mm.
/// Errors       as mend_mesh; bad_input where there is nothing inside (an open sheet); memory: the
///              level set would not fit, the message names the voxel that does.
/// Accuracy     as mend_mesh; through the field a voxel (MeshRepair.*).
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         mend_mesh's; the field as an import at its voxel.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh_mm, const RepairOptions& options = {},
                                 const Progress& progress = {});

}  // namespace argil::io
