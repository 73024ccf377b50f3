// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include <imgui.h>

#include "commands/ui_state.h"

namespace argil::viewer {

/// What is known of a file in a list; null as long as nothing is.
const ShownFile* known_file(const UiState& ui, const std::filesystem::path& file);

/// Draws a picture into a rectangle, as large as fits; without one the rectangle alone, with a word
/// in its middle.
void draw_picture_in(const ShownPicture& picture, ImDrawList& list, const ImVec2& low,
                     const ImVec2& high, const char* word);

/// "28 November 2026, 14:03, 12.4 MB".
std::string words_of_look(const FileLook& look);

}  // namespace argil::viewer
