// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

struct Crumbs {
  TriangleMesh mesh;
  std::int64_t count = 0;
};

/// Takes out closed parts that enclose less than one voxel: specks that no print can show, and that
/// a slicer would count as parts.
Crumbs drop_crumbs(TriangleMesh& mesh, double voxel_mm);

}  // namespace argil::io
