// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil::evaluation {

/// Where a mesh that is not part of the repository lies, there or not: in the folder models of the
/// folder that the environment variable ARGIL_SHARED names, by default the current one.
std::filesystem::path model_file(const std::string& name);

/// What a chart says of a piece whose model is not there.
std::string missing_model(const std::string& piece, const std::filesystem::path& file);

/// The mesh with its holes closed, about the origin, its longest side `size_mm`.
Result<TriangleMesh> read_model(const std::filesystem::path& file, double size_mm);

/// The same as clay.
Result<Clay> import_model(const std::filesystem::path& file, double size_mm, double voxel_mm);

}  // namespace argil::evaluation
