// SPDX-License-Identifier: GPL-3.0-or-later
// By libpng's simplified interface, which brings any kind to eight bits of sRGB.
#include "format/png_read.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include <png.h>
#include <sys/types.h>

#include "argil/core/pace.h"

#include "format/png_text.h"

namespace argil::io {
namespace {

/// What libpng holds of an image, given back in any case.
struct PngHeader {
  png_image image;
  PngHeader() {
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
  }
  ~PngHeader() { png_image_free(&image); }
  PngHeader(const PngHeader&) = delete;
  PngHeader& operator=(const PngHeader&) = delete;
};

/// The bytes of a PNG on their way to libpng, as a stream, because libpng asks nobody while it
/// unpacks what lies in memory.
struct PngBytes {
  std::vector<std::span<const std::byte>> parts;
  std::size_t size = 0;   ///< of all
  std::size_t given = 0;  ///< of all
  std::size_t part = 0;   ///< from which comes what is next
  const Progress& progress;
  bool is_stopped = false;
};

/// A fault makes libpng give up. No exception may pass it.
ssize_t give_bytes(void* cookie, char* to, std::size_t size) noexcept {
  PngBytes& bytes = *static_cast<PngBytes*>(cookie);
  bytes.is_stopped = bytes.progress && !bytes.progress("read", static_cast<double>(bytes.given) /
                                                                   static_cast<double>(bytes.size));
  if (bytes.is_stopped) return -1;
  std::size_t given = 0;
  while (given < size && bytes.part < bytes.parts.size()) {
    std::span<const std::byte>& left = bytes.parts[bytes.part];
    const std::size_t count = std::min(size - given, left.size());
    std::memcpy(to + given, left.data(), count);
    left = left.subspan(count);
    given += count;
    if (left.empty()) ++bytes.part;
  }
  bytes.given += given;
  return static_cast<ssize_t>(given);
}

struct CloseStream {
  void operator()(std::FILE* stream) const noexcept { std::fclose(stream); }
};

}  // namespace

Result<ClearImage> parse_png(const std::filesystem::path& file, std::span<const std::byte> bytes,
                             const ImageBounds& bounds, const Progress& progress) {
  // Texts are not wanted, and each may unpack to megabytes, of which libpng keeps a thousand.
  PngBytes given{pixel_parts(bytes), bytes.size(), 0, 0, progress, false};
  const std::unique_ptr<std::FILE, CloseStream> stream(
      ::fopencookie(&given, "rb", {give_bytes, nullptr, nullptr, nullptr}));
  if (!stream) throw std::bad_alloc();
  PngHeader header;
  png_image& image = header.image;
  const auto fault = [&]() -> Error {
    if (given.is_stopped) throw Interrupted();
    return damaged_image_error(file, image.message);
  };
  if (png_image_begin_read_from_stdio(&image, stream.get()) == 0) return fault();
  if (auto fits = check_sides(file, image.width, image.height, bounds); !fits) return fits.error();
  image.format = PNG_FORMAT_RGBA;
  ClearImage read{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  read.rgba.resize(PNG_IMAGE_SIZE(image));
  // Rows follow one another without a gap, and nothing is laid below what is clear.
  if (png_image_finish_read(&image, nullptr, read.rgba.data(), 0, nullptr) == 0) return fault();
  return read;
}

}  // namespace argil::io
