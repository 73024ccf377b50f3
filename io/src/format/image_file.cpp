// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/image_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <span>

#include "argil/core/no_throw.h"

#include "file/file_bytes.h"
#include "format/image_format.h"
#include "format/jpeg_read.h"
#include "format/png_read.h"

namespace argil::io {
Result<ClearImage> read_image(const std::filesystem::path& file, std::int64_t most_pixels,
                              const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<ClearImage> {
    const auto bytes = read_file_bytes(file, progress);
    if (!bytes) return bytes.error();
    const ImageBounds bounds{1, kMostImageSide, most_pixels};
    switch (image_format_of(bytes.value())) {
      case ImageFormat::png:
        return parse_png(file, bytes.value(), bounds, progress);
      case ImageFormat::jpeg:
        return parse_jpeg(file, bytes.value(), bounds, progress);
      case ImageFormat::none:
        break;
    }
    return no_image_error(file);
  });
}

bool is_image_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;  // a pipe would be waited for
  std::array<char, kImageSignature> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto got = static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0));
  return image_format_of(std::as_bytes(std::span(head)).first(got)) != ImageFormat::none;
}

}  // namespace argil::io
