// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::evaluation {

// Meshes that one operator of Blender makes of others. Blender is started once, without a window,
// ends with the call and leaves nothing behind.
//
// Units   voxel_mm above 0; the operator is run up to `runs` times, 1 or more, for two seconds.
// Errors  interrupted; disk; internal where Blender failed or took ten minutes, with its reason.

/// What keeps them from being made here, as "Blender: ... is not installed"; "" when nothing does.
std::string made_mesh_obstacle();

struct BlenderMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;  ///< two of each quad; there are no normals
  double cpu_us = 0.0;              ///< of the operator alone, all threads; median of the runs
  double wall_us = 0.0;
};

/// The voxel remesher with its own settings: it measures distances from the triangles, meshes them
/// (volumeToMesh), and draws the vertices back onto the triangles.
Result<BlenderMesh> blender_remesh(const TriangleMesh& surface_mm, double voxel_mm, int runs,
                                   const Progress& progress);

/// The union of two closed meshes by the modifier Boolean with its solver "Exact".
Result<BlenderMesh> blender_union(const TriangleMesh& a_mm, const TriangleMesh& b_mm, int runs,
                                  const Progress& progress);

}  // namespace argil::evaluation
