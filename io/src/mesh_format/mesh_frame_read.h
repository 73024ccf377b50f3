// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_frame.h"

namespace argil::io {

/// Reads a mesh of any format, in mm and z up; `report` says how it was understood, without
/// guesses. Errors  as read_mesh.
Result<TriangleMesh> read_in_frame(const std::filesystem::path& file, const MeshFrame& wanted,
                                   FrameReport& report);

}  // namespace argil::io
