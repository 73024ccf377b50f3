// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/decimate.h"

namespace argil::io {

/// Of a bound that was asked for: so much nearer than it counts as beyond already, where no more is
/// known.
inline constexpr double kSafeFraction = 0.02;

/// What measure_error says; with `bound_mm` > 0 also appends to `far` a
/// point of each triangle of either that is not certain to lie within it (may_exceed()). Throws
/// Interrupted.
mesh::MeshError field_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            const TriangleMesh& left_out, double bound_mm,
                            std::vector<mesh::FarPoint>& far, const Pace& pace);

}  // namespace argil::io
