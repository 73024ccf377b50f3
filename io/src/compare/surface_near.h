// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil::io {

/// The triangles of an extracted surface that lie near what was left out of it, within eight cells
/// of the coarsest there and up to twice as far: among them all that LeftOutParts needs to tell
/// what is ambiguous, which only cells with a vertex of what was left out can be.
///
/// Shapes       surface, left_out: as LeftOutParts has them. Triangles in the old order.
/// Errors       throws Interrupted.
/// Threads      as Clay; spreads over TBB.
/// Cost         20 ns a vertex of the surface.
TriangleMesh surface_near(const TriangleMesh& surface, const TriangleMesh& left_out,
                          const Clay& clay, const Pace& pace);

}  // namespace argil::io
