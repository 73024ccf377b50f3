// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/certificate.h"

#include "compare/extracted_surface.h"

namespace argil::io {

/// What measure_error says. Neither mesh is empty. Throws Interrupted.
mesh::MeshError field_error(const TriangleMesh& mesh, ExtractedSurface& surface, const Pace& pace);

}  // namespace argil::io
