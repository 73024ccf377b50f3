// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triangle_mesh.h"

namespace argil {

/// Whether import_mesh would find room for its estimate of a mesh at this voxel size, as it asks
/// before it allocates: nine tenths of what this process may still take.
///
/// Shapes       mesh_mm as for import_mesh; `is_closed`: every edge is run along as often one way
///              as the other.
/// Units        voxel_mm > 0.
/// Accuracy     an estimate from the area: docs/import.md.
/// Threads      any.
/// Cost         linear in the triangles.
bool is_import_likely_to_fit(const TriangleMesh& mesh_mm, bool is_closed, double voxel_mm);

}  // namespace argil
