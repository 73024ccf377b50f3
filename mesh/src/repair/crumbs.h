// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Leaves out flat crumbs that mending cut off or closed: components with at least one triangle
/// that is not one of `given`, less than a millionth of the volume and a mean thickness of less
/// than 3e-4 of the diagonal. Parts that were given whole stay, however small. Returns how many
/// went.
///
/// Shapes       closed; corners of triangles that are still given have their bits.
/// Determinism  same bits every time.
/// Threads      one. Linear.
std::int64_t drop_crumbs(TriangleMesh& mesh, const TriangleMesh& given);

}  // namespace argil::mesh
