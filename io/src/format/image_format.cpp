// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/image_format.h"

#include <algorithm>
#include <array>

namespace argil::io {

ImageFormat image_format_of(std::span<const std::byte> bytes) noexcept {
  constexpr std::array<unsigned char, kImageSignature> kPng{0x89, 'P',  'N',  'G',
                                                            '\r', '\n', 0x1A, '\n'};
  constexpr std::array<unsigned char, 3> kJpeg{0xFF, 0xD8, 0xFF};  // a start, then a marker
  const auto begins = [&](const auto& signature) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin(),
                      [](unsigned char a, std::byte b) { return std::byte{a} == b; });
  };
  if (begins(kPng)) return ImageFormat::png;
  return begins(kJpeg) ? ImageFormat::jpeg : ImageFormat::none;
}

Result<void> check_sides(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                         const ImageBounds& bounds) {
  const std::string sides =
      " is " + std::to_string(width) + " by " + std::to_string(height) + " pixels; ";
  if (std::min(width, height) < bounds.least_side || std::max(width, height) > bounds.most_side) {
    return file_error(ErrorKind::bad_input, file,
                      sides + "each side must be from " + std::to_string(bounds.least_side) +
                          " to " + std::to_string(bounds.most_side));
  }
  if (width * height <= bounds.most_pixels) return {};
  return file_error(
      ErrorKind::bad_input, file,
      sides + "it may have " + std::to_string(bounds.most_pixels) + " in all: make it smaller");
}

}  // namespace argil::io
