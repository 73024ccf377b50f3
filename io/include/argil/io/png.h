// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/render.h"

namespace argil::io {

/// Writes an 8-bit RGB PNG by temporary file, sync, rename.
/// Errors  bad_input when the image has no pixels or not three bytes for each; disk; interrupted:
///         `progress` is asked whenever some kilobytes are packed.
Result<void> write_png(const std::filesystem::path& file, const Image& image,
                       const Progress& progress = {});

/// The bytes of such a file. `name` is what errors call it.
/// Errors  bad_input, interrupted: as write_png.
Result<std::vector<std::byte>> pack_png(const std::string& name, const Image& image,
                                        const Progress& progress = {});

}  // namespace argil::io
