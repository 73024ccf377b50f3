// SPDX-License-Identifier: GPL-3.0-or-later
// PNG by libpng's simplified interface, eight bits a channel, sRGB.
#include "argil/io/png.h"

#include <cassert>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <png.h>
#include <sys/types.h>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/file_error.h"
#include "format/image_format.h"
#include "format/png_read.h"
#include "format/png_text.h"

namespace argil::io {
namespace {

/// The bytes of a PNG as libpng makes them, and why it may not go on.
struct PackedRows {
  const Progress& progress;
  std::vector<std::byte> bytes;
  bool is_stopped = false;
  bool is_out_of_memory = false;
};

/// Takes some bytes of the stream; 0 makes libpng give up. No exception may pass it.
ssize_t take(void* cookie, const char* data, std::size_t size) noexcept {
  PackedRows& packed = *static_cast<PackedRows*>(cookie);
  packed.is_stopped = packed.progress && !packed.progress("save", 0.0);
  if (packed.is_stopped) return 0;
  try {
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    packed.bytes.insert(packed.bytes.end(), begin, begin + size);
  } catch (const std::bad_alloc&) {
    packed.is_out_of_memory = true;
    return 0;
  }
  return static_cast<ssize_t>(size);
}

/// Packs the image; false when libpng refuses it, with the reason in `reason`.
bool pack(const Image& image, PackedRows& packed, std::string& reason) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  // A stream and not memory, because libpng asks nobody while it packs.
  std::FILE* const stream = ::fopencookie(&packed, "wb", {nullptr, take, nullptr, nullptr});
  if (stream == nullptr) throw std::bad_alloc();
  const bool is_packed =
      // No conversion to 8 bits, and rows follow one another without a gap.
      png_image_write_to_stdio(&header, stream, 0, image.rgb.data(), 0, nullptr) != 0;
  const bool is_taken = std::fclose(stream) == 0;
  reason = static_cast<const char*>(header.message);
  return is_packed && is_taken;
}

bool has_all_pixels(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.rgb.size() ==
             3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

}  // namespace

Result<std::vector<std::byte>> pack_png(const std::string& name, const Image& image,
                                        const Progress& progress) {
  return no_throw(name, [&]() -> Result<std::vector<std::byte>> {
    if (!has_all_pixels(image)) {
      return Error{ErrorKind::bad_input, "cannot write '" + name + "': the picture is " +
                                             std::to_string(image.width) + " by " +
                                             std::to_string(image.height) + " pixels with " +
                                             std::to_string(image.rgb.size()) +
                                             " bytes; it needs three bytes for each pixel"};
    }
    std::string reason;
    PackedRows packed{progress, {}};
    const bool is_packed = pack(image, packed, reason);
    if (packed.is_stopped) throw Interrupted();
    if (packed.is_out_of_memory) throw std::bad_alloc();
    if (!is_packed) return Error{ErrorKind::internal, "cannot encode '" + name + "': " + reason};
    return std::move(packed.bytes);
  });
}

Result<std::vector<std::byte>> pack_png(const std::string& name, const Image& image,
                                        const std::vector<PngText>& texts,
                                        const Progress& progress) {
  return no_throw(name, [&]() -> Result<std::vector<std::byte>> {
    for (const PngText& text : texts) {
      if (is_png_text(text)) continue;
      return Error{ErrorKind::bad_input,
                   "cannot write '" + name + "': PNG cannot keep the text '" + text.key +
                       "'; its name needs 1 to 79 printable letters, and it must have no NUL"};
    }
    auto packed = pack_png(name, image, progress);
    if (!packed) return packed.error();
    return with_texts(std::move(packed).value(), texts);
  });
}

Result<void> write_png(const std::filesystem::path& file, const Image& image,
                       const Progress& progress) {
  const auto bytes = pack_png(file.string(), image, progress);
  if (!bytes) return bytes.error();
  return no_throw(file.string(), [&]() -> Result<void> {
    return replace_file(file, [&](const std::filesystem::path& temporary) {
      OutputFile out(temporary);
      out.write(bytes.value().data(), bytes.value().size());
      return out.close();
    });
  });
}

Result<TextedImage> read_small_png(const std::filesystem::path& file, int most_side) {
  assert(most_side > 0 && most_side <= kMostImageSide);
  return no_throw(file.string(), [&]() -> Result<TextedImage> {
    const auto side = static_cast<std::uintmax_t>(most_side);
    const std::uintmax_t most_bytes = 8 * side * side + 65536;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > most_bytes) {
      return file_error(ErrorKind::bad_input, file,
                        " has " + std::to_string(size) + " bytes; a picture of this kind has " +
                            std::to_string(most_bytes) + " at most");
    }
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    if (image_format_of(bytes.value()) != ImageFormat::png) {
      return file_error(ErrorKind::bad_input, file, " is no PNG; save the image as one");
    }
    const ImageBounds bounds{1, most_side, std::int64_t{most_side} * most_side};
    auto image = parse_png(file, bytes.value(), bounds, {});
    if (!image) return image.error();
    auto texts = texts_of(bytes.value());
    if (!texts) {
      return file_error(ErrorKind::bad_input, file, " has a damaged text; save the image again");
    }
    return TextedImage{std::move(image).value(), std::move(*texts)};
  });
}

}  // namespace argil::io
