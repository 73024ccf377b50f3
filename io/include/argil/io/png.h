// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/result.h"
#include "argil/engine/render.h"

namespace argil::io {

/// Writes an 8-bit RGB PNG by temporary file, sync, rename.
/// Errors  bad_input when the image has no pixels or not three bytes for each; disk.
Result<void> write_png(const std::filesystem::path& file, const Image& image);

}  // namespace argil::io
