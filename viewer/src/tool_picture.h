// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "brush.h"

namespace argil::viewer {

/// Draws what a tool does: clay in section, with the line of before where it was another, the tool
/// and its way. Lines and areas, so that it is crisp at any size.
/// Units  pixels; `corner` the upper left, the height is 0.7 of `width`.
void draw_tool_picture(const ActionInfo& tool, ImDrawList& list, ImVec2 corner, float width);

}  // namespace argil::viewer
