// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_check.h"
#include "argil/io/printer.h"

#include "mesh_wall.h"
#include "pace.h"

namespace argil::io {

/// check_print with its walls measured by `walls`. Throws Interrupted and what libraries throw.
MeshVerdict judge_mesh(const TriangleMesh& mesh_mm, const Printer& printer, std::int64_t file_bytes,
                       const WallMeasure& walls, const Pace& pace);

}  // namespace argil::io
