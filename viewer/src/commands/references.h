// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "commands/ui_state.h"

namespace argil::viewer {

/// Another reference image, in the straight view that the window shows, else in front: the window
/// looks there then, and lists them. As large as the clay. What cannot be read is said.
void add_reference(const std::filesystem::path& file, UiState& ui);

}  // namespace argil::viewer
