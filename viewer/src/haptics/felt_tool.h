// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/force/tool_force.h"

#include "commands/brush.h"

namespace argil::viewer {

/// The brush's tool as it is felt: no smaller and no larger than a device may feel, a mesh as the
/// ball around it. Its position is left out.
haptics::ForceTool felt_tool(const Brush& brush, double radius_mm);

/// Radius of the ball that the felt tool cuts away where it is (RigOptions::own_cut_mm); 0 where
/// the brush does something else, or not just there.
double own_cut_mm(const Brush& brush, double radius_mm);

}  // namespace argil::viewer
