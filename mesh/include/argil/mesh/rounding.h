// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::mesh {

/// The coordinates as a file holds them: each the nearest float (ties to even), infinite where none
/// is large enough: beyond 3.4e38.
std::array<float, 3> floats_of(const Vec3& p) noexcept;

/// A mesh as a reader of its file will see it: every coordinate the nearest float, infinite where
/// none is large enough. Triangles and normals stay. Slivers may fold over or lose their area by
/// it, and points that were apart may meet: check it afterwards (collapse_folded.h). A second time
/// changes nothing.
///
/// Threads      any; allocates only what copying `mesh` takes: move it in. Linear.
TriangleMesh rounded_to_float(TriangleMesh mesh);

}  // namespace argil::mesh
