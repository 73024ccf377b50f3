// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/decimate.h"

namespace argil::io {

/// What measure_error says; with `bound_mm` > 0 also appends the points found beyond it to `far`:
/// all kinds of them, but not each one. Throws Interrupted.
mesh::MeshError field_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            const TriangleMesh& left_out, double bound_mm,
                            std::vector<mesh::FarPoint>& far, const Pace& pace);

}  // namespace argil::io
