// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/certificate.h"

namespace argil::io {

/// What measure_error says. Throws Interrupted.
mesh::MeshError field_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            const TriangleMesh& left_out, const Pace& pace);

}  // namespace argil::io
