// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <string>

#include "argil/core/result.h"
#include "argil/engine/tool.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::cli {

/// Reads --tool: ball:R, ellipsoid:A,B,C, box:A,B,C or capsule:R,L in mm into shape and radii.
/// Throws CLI::ValidationError.
void read_tool(const std::string& text, haptics::ForceTool& tool);

inline double largest_radius_mm(const haptics::ForceTool& tool) {
  assert(std::min({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z}) > 0.0);
  return std::max({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z});
}

/// What a felt tool may do to the clay, in the order that recordings of the lab count them by.
inline constexpr std::array kWorkActions = {Action::add, Action::carve, Action::smooth,
                                            Action::inflate};
inline constexpr std::initializer_list<const char*> kWorkActionNames = {
    info_of(kWorkActions[0]).name, info_of(kWorkActions[1]).name, info_of(kWorkActions[2]).name,
    info_of(kWorkActions[3]).name};

/// The tool that works the clay as that one is felt. `action`: which of kWorkActions.
/// Errors  bad_input for a shape other than ball and ellipsoid; as validate_tool.
Result<Tool> working_tool(const haptics::ForceTool& felt, std::size_t action);

}  // namespace argil::cli
