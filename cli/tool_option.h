// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "argil/core/result.h"
#include "argil/engine/tool.h"
#include "argil/haptics/tool_force.h"

namespace argil::cli {

/// Reads --tool: ball:R, ellipsoid:A,B,C, box:A,B,C or capsule:R,L in mm into shape and radii.
/// Throws CLI::ValidationError.
void read_tool(const std::string& text, haptics::ForceTool& tool);

inline double largest_radius_mm(const haptics::ForceTool& tool) {
  return std::max({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z});
}

/// The tool that works the clay as that one is felt. `action`: of engine's Action.
/// Errors  bad_input for a shape other than ball and ellipsoid; as validate_tool.
Result<Tool> working_tool(const haptics::ForceTool& felt, std::size_t action);

}  // namespace argil::cli
