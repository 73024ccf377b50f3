// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "argil/core/result.h"

#include "file/file_error.h"

namespace argil::io {

enum class ImageFormat { none, png, jpeg };

/// Bytes from the start of a file that tell which it is.
inline constexpr std::size_t kImageSignature = 8;

/// By the first bytes alone.
ImageFormat image_format_of(std::span<const std::byte> bytes) noexcept;

inline Error no_image_error(const std::filesystem::path& file) {
  return file_error(ErrorKind::bad_input, file,
                    " is neither PNG nor JPEG; save the image as one of them");
}

/// What whoever asks takes; pixels a side, and in all.
struct ImageBounds {
  std::int64_t least_side = 1;
  std::int64_t most_side = 0;
  std::int64_t most_pixels = 0;
};

/// Errors  bad_input naming the file, its sides and the bound.
Result<void> check_sides(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                         const ImageBounds& bounds);

/// In a library's words.
inline Error damaged_image_error(const std::filesystem::path& file, const char* words) {
  std::string what(" is damaged (");
  what.append(words).append("); save the image again");
  return file_error(ErrorKind::bad_input, file, what);
}

}  // namespace argil::io
