// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "argil/engine/action_picture.h"

namespace argil::viewer {

/// Draws what a tool does: clay in section, with the line of before where it was another, the tool
/// and its path. Lines and areas, so that it is crisp at any size.
/// Units  pixels; `corner` the upper left, the height is 0.7 of `width`.
void draw_tool_picture(const ActionPicture& picture, ImDrawList& list, ImVec2 corner, float width);

}  // namespace argil::viewer
