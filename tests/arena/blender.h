// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "arena/contestants.h"

namespace argil::arena {

/// Blender's voxel remesher, with a 256th of the largest side as voxel. One Blender serves all
/// runs, and another begins where one has crashed or hung.
///
/// Threads  any; one run at a time.
Attempt run_blender(const std::filesystem::path& folder, const std::filesystem::path& broken);

}  // namespace argil::arena
