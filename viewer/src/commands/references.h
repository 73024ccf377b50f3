// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "commands/ui_state.h"
#include "picture/reference_image.h"

namespace argil::viewer {

/// Asks for another reference image, in the straight view that the window shows, else in front: the
/// window looks there, and lists it. It is put there once it was read (put_reference).
void add_reference(const std::filesystem::path& file, UiState& ui);

/// One whose pixels are there: as large as the clay.
void put_reference(const ReferenceWish& wish, std::shared_ptr<const ReferencePixels> pixels,
                   UiState& ui);

}  // namespace argil::viewer
