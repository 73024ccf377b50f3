// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

namespace argil::viewer {

/// The images of `examples/alphas/`, as they were when the program was built: file name and bytes.
using AlphaBytes = std::pair<std::string_view, std::span<const unsigned char>>;
const std::vector<AlphaBytes>& built_in_alphas();

/// Pixels along the side of a small picture of an image.
inline constexpr std::size_t kThumbSide = 24;

/// An image that can be chosen.
struct AlphaChoice {
  std::filesystem::path file;
  std::string name;  ///< the file's, without its extension
  /// Rows from the top, 0 black to 255 white; the longer side of the image fills it, and what it
  /// leaves free is black.
  std::array<std::uint8_t, kThumbSide * kThumbSide> thumb{};
};

/// The PNG and JPEG images in HOME/alphas, by name. Where there is no such folder, it is made with
/// the built-in ones in it: who removes some of them is not given them again.
struct AlphaList {
  std::vector<AlphaChoice> alphas;
  std::vector<Error> problems;  ///< of files that are no image, or could not be written
};
/// Where `progress` says so it ends early, with those that were read until then.
/// Cost  decodes every image: 4 ms for one of 256 x 256 pixels.
AlphaList read_alphas(const std::filesystem::path& home, const Progress& progress = {});

/// Copies an image into HOME/alphas as a PNG, under its own name or, where another image has that,
/// the next free one; the file there. One that lies there already stays.
/// Errors  bad_input, where it is no image, and interrupted, as io::read_alpha; disk.
Result<std::filesystem::path> add_alpha(const std::filesystem::path& home,
                                        const std::filesystem::path& file,
                                        const Progress& progress = {});

}  // namespace argil::viewer
