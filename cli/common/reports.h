// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/io/export.h"
#include "argil/io/mesh_repair.h"

#include "common/outcome.h"

namespace argil::cli {

// Reports as objects with the keys of docs/command_line.md, for commands and for Python.

/// What is in a clay; box, volume and area of its surface, all in the clay's own frame.
Json clay_json(const Clay& clay, const TriangleMesh& surface);

Json export_json(const io::ExportReport& report, double seconds);

/// `triangles`: of the repaired mesh.
Json repair_json(const io::RepairReport& report, std::size_t triangles);

}  // namespace argil::cli
