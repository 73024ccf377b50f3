// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

namespace argil::io {

/// An image with transparency: four bytes a pixel, red, green, blue and opacity, in sRGB, rows from
/// the top.
struct ClearImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// The longest side of an image that read_image takes.
inline constexpr int kMostImageSide = 16384;

/// Reads a PNG or a JPEG, which is told by its content, not by its name, as eight bits a channel.
///
/// PNG          of any kind, brought to sRGB by the gamma that it names.
/// JPEG         baseline or progressive, grey or in colours, of eight bits a channel; turned and
///              mirrored as Exif's orientation says. Its colours are taken for sRGB: a profile in
///              it is not followed.
/// Errors       bad_input naming the file: neither of them; a side of more than kMostImageSide or
///              more than `most_pixels` in all, before any pixel is unpacked; damaged or cut off,
///              in the library's words; of JPEGs those in CMYK, with more than eight bits, without
///              loss or with more than 100 scans. interrupted, when `progress` says so: it is asked
///              after 16 MB of a file, every 8 KB of a PNG and every row of a JPEG. disk, memory.
/// Threads      any.
/// Cost         PNG 18 ns a pixel, JPEG 5, a progressive one 14: bench_images. 4 bytes a pixel
///              besides those of the file, of a progressive JPEG up to 6 more.
Result<ClearImage> read_image(const std::filesystem::path& file, std::int64_t most_pixels,
                              const Progress& progress = {});

/// Whether a file begins as a PNG or a JPEG does; false where it cannot be read.
/// Errors  none. Threads  any.
bool is_image_file(const std::filesystem::path& file);

}  // namespace argil::io
