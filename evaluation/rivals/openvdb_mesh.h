// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil::evaluation {

/// The surface of a clay's finest level as another mesher has it.
struct OpenvdbMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;  ///< two of each quad; there are no normals
  double cpu_us = 0.0;              ///< of the mesher alone, all threads
  double wall_us = 0.0;
};

/// openvdb::tools::volumeToMesh without its adaptivity.
OpenvdbMesh openvdb_mesh(const Clay& clay);

}  // namespace argil::evaluation
