// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/io/assembly.h"
#include "argil/io/mesh_frame.h"

namespace argil::io {

/// Reads a file of any format, in mm and z up; its frame is without guesses. Errors  as read_mesh.
Result<ReadAssembly> read_in_frame(const std::filesystem::path& file, const MeshFrame& wanted);

}  // namespace argil::io
