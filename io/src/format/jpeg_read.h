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

/// The JPEG in `bytes`, as read_image has it; `file` is what errors call it. Throws Interrupted and
/// std::bad_alloc.
Result<ClearImage> parse_jpeg(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const ImageBounds& bounds, const Progress& progress);

}  // namespace argil::io
