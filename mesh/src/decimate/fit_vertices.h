// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/decimate.h"

namespace argil::mesh {

/// Moves vertices so that the triangles lie on the field as nearly as they can: the integral of
/// phi^2 over the mesh becomes less with every sweep. No triangle turns over. Vertices in
/// `fixed` (one for each) stay. Throws Interrupted; the mesh is then as some sweep left it.
///
/// Method  Gauss-Newton in sweeps. Each sample of a triangle asks all three corners for the same
///         step, weighted by how near it is to them, which by Jensen's inequality never overshoots;
///         the step of a corner is then over-relaxed.
void fit_vertices(TriangleMesh& mesh, const DecimationTarget& target,
                  const std::vector<bool>& fixed, const Pace& pace);

}  // namespace argil::mesh
