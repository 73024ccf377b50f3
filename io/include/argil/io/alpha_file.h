// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/alpha_image.h"

namespace argil::io {

/// Reads a PNG or a JPEG, told by its content, as the image of a tool. A PNG has 1 to 16 bits a
/// channel, grey, colour or with a palette, interlaced or not; a JPEG is one that read_image
/// (image_file.h) takes. Of 8 bits 255 becomes 65535. Colours count by their luma (.2126, .7152,
/// .0722), what is transparent as if it lay on black; values are heights, so that neither a gamma
/// nor a colour profile in the file changes them.
///
/// Errors  bad_input naming the file: neither of them; a side that AlphaImage does not take, before
///         any pixel is unpacked; damaged or cut off, in the library's words; a JPEG of a kind that
///         read_image refuses. interrupted, when `progress` says so: asked for every row. disk,
///         memory.
/// Cost    40 ns a pixel, and up to 8 bytes a pixel besides those of the image.
Result<std::shared_ptr<const AlphaImage>> read_alpha(const std::filesystem::path& file,
                                                     const Progress& progress = {});

/// Writes the pixels as a grey PNG of 16 bits, by temporary file, sync, rename: read_alpha gives
/// the same image.
/// Errors  disk; memory.
Result<void> write_alpha(const std::filesystem::path& file, const AlphaImage& image);

/// Of size and pixels, 16 hexadecimal digits: what a stroke script names an image by. That a file
/// was packed otherwise, or had 8 bits, does not matter.
std::string alpha_hash(const AlphaImage& image);

}  // namespace argil::io
