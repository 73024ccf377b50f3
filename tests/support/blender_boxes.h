// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "argil/engine/sculpture.h"

namespace argil::test {

/// The boxes around what Blender shows of a project, of each level of each piece that has a surface
/// there, by the name of its grid: "Head/surface_0". A failure of the test where it shows nothing.
std::map<std::string, Box3> blender_boxes(const std::filesystem::path& project);

/// The box around the surface of a piece where it stands.
Box3 placed_surface(const Sculpture& sculpture, std::size_t piece);

}  // namespace argil::test
