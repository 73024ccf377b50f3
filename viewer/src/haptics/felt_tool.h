// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/force/tool_force.h"

#include "commands/brush.h"

namespace argil::viewer {

/// The brush's tool as it is felt: no smaller and no larger than a device may feel, a mesh as the
/// ball around it. Its position is left out.
haptics::ForceTool felt_tool(const Brush& brush, double radius_mm);

}  // namespace argil::viewer
