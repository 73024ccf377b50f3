// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/io/image_file.h"

#include "format/image_format.h"

namespace argil::io {

/// A PNG of any kind, by its bytes. Errors  as read_image(); throws what an allocation throws, and
/// Interrupted as `progress` says.
Result<ClearImage> parse_png(const std::filesystem::path& file, std::span<const std::byte> bytes,
                             const ImageBounds& bounds, const Progress& progress);

}  // namespace argil::io
