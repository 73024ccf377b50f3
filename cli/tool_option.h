// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "argil/haptics/tool_force.h"

namespace argil::cli {

/// Reads --tool: ball:R, ellipsoid:A,B,C, box:A,B,C or capsule:R,L in mm into shape and radii.
/// Throws CLI::ValidationError.
void read_tool(const std::string& text, haptics::ForceTool& tool);

}  // namespace argil::cli
