// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::evaluation {

/// What keeps Blender's remesher from being measured here, as "Blender: ... is not installed"; ""
/// when nothing does.
std::string remesh_obstacle();

/// What the remesher makes of a surface.
struct BlenderRemesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;  ///< two of each quad; there are no normals
  double cpu_us = 0.0;              ///< of the operator alone, all threads; median of the runs
  double wall_us = 0.0;
};

/// Runs Blender once, without a window, and has its voxel remesher make a surface anew, with its
/// own settings: it measures distances from the triangles, meshes them (volumeToMesh), and draws
/// the vertices back onto the triangles. Blender ends with this call and leaves nothing behind.
///
/// Units   voxel_mm above 0; the operator is run up to `runs` times, 1 or more, for two seconds.
/// Errors  interrupted; disk; internal where Blender failed or took ten minutes, with its reason.
Result<BlenderRemesh> blender_remesh(const TriangleMesh& surface_mm, double voxel_mm, int runs,
                                     const Progress& progress);

}  // namespace argil::evaluation
