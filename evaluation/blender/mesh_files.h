// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

// A mesh as scripts for Blender take and give it: floats in NAME.positions, corners in
// NAME.triangles.

/// Errors  disk.
Result<void> write_mesh_files(const std::filesystem::path& name, const TriangleMesh& mesh);

/// None where a file is missing or cut off, or there is no triangle. Without normals.
std::optional<TriangleMesh> read_mesh_files(const std::filesystem::path& name);

}  // namespace argil::evaluation
