// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/render.h"
#include "argil/io/image_file.h"

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

/// A word about an image, as PNG has it in a tEXt chunk.
struct PngText {
  std::string key;   ///< 1 to 79 printable letters of Latin-1, without blanks at the ends
  std::string text;  ///< Latin-1 without NUL
  friend bool operator==(const PngText&, const PngText&) = default;
};

/// As pack_png, with texts before the pixels.
/// Errors  also bad_input, naming the key: a text that PNG cannot keep.
Result<std::vector<std::byte>> pack_png(const std::string& name, const Image& image,
                                        const std::vector<PngText>& texts,
                                        const Progress& progress = {});

/// A PNG with its texts; what is compressed or of many languages (zTXt, iTXt) is left out.
struct TextedImage {
  ClearImage image;
  std::vector<PngText> texts;  ///< in the order of the file
};

/// Such a PNG as read_image() reads it, of a small picture that anybody may have written: nothing
/// is unpacked of one with a side above `most_side` pixels, or of a file of more than 8 bytes for
/// each pixel of such a picture and 64 KB.
///
/// Errors   as read_image, with these bounds in the place of its own; also bad_input for what is no
///          PNG, and for a damaged text.
/// Threads  any.
Result<TextedImage> read_small_png(const std::filesystem::path& file, int most_side);

}  // namespace argil::io
