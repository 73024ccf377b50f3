// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/png.h"

#include <cstring>
#include <string>
#include <vector>

#include <png.h>

#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "no_throw.h"

namespace argil::io {
namespace {

/// The PNG of an image in memory; empty when libpng refuses it, with the reason in `reason`.
std::vector<std::byte> encode(const Image& image, std::string& reason) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) ==
      0) {
    reason = static_cast<const char*>(header.message);
    return {};
  }
  bytes.resize(size);
  return bytes;
}

bool has_all_pixels(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.rgb.size() ==
             3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

}  // namespace

Result<void> write_png(const std::filesystem::path& file, const Image& image) {
  return no_throw(file.string(), [&]() -> Result<void> {
    if (!has_all_pixels(image)) {
      return Error{ErrorKind::bad_input, "cannot write '" + file.string() + "': the picture is " +
                                             std::to_string(image.width) + " by " +
                                             std::to_string(image.height) + " pixels with " +
                                             std::to_string(image.rgb.size()) +
                                             " bytes; it needs three bytes for each pixel"};
    }
    std::string reason;
    const std::vector<std::byte> bytes = encode(image, reason);
    if (bytes.empty()) {
      return Error{ErrorKind::internal, "cannot encode '" + file.string() + "': " + reason};
    }
    return replace_file(file, [&](const std::filesystem::path& temporary) {
      OutputFile out(temporary);
      out.write(bytes.data(), bytes.size());
      return out.close();
    });
  });
}

}  // namespace argil::io
