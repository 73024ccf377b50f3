// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// Leaves out closed parts that enclose less than one voxel: specks that no print can show, and
/// that a slicer would count as parts. How many were left out.
std::int64_t drop_crumbs(TriangleMesh& mesh, double voxel_mm);

}  // namespace argil::io
