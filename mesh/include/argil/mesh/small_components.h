// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Components that were taken out of a mesh, and how many.
struct SmallComponents {
  TriangleMesh mesh;
  std::int64_t count = 0;
};

/// Takes out the closed components that enclose less than one voxel: specks that no print can show,
/// and that a slicer would count as parts.
///
/// Units        voxel_mm > 0.
/// Cost         linear.
SmallComponents drop_small_components(TriangleMesh& mesh, double voxel_mm);

}  // namespace argil::mesh
