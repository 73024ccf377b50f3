// SPDX-License-Identifier: GPL-3.0-or-later
// By libpng's simplified interface, which brings any kind to eight bits of sRGB.
#include "format/png_read.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include <png.h>
#include <sys/types.h>

#include "argil/core/pace.h"

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
  std::span<const std::byte> left;
  std::size_t size = 0;
  const Progress& progress;
  bool is_stopped = false;
};

/// A fault makes libpng give up. No exception may pass it.
ssize_t give_bytes(void* cookie, char* to, std::size_t size) noexcept {
  PngBytes& bytes = *static_cast<PngBytes*>(cookie);
  const double left = static_cast<double>(bytes.left.size());
  bytes.is_stopped =
      bytes.progress && !bytes.progress("read", 1.0 - left / static_cast<double>(bytes.size));
  if (bytes.is_stopped) return -1;
  const std::size_t given = std::min(size, bytes.left.size());
  std::memcpy(to, bytes.left.data(), given);
  bytes.left = bytes.left.subspan(given);
  return static_cast<ssize_t>(given);
}

struct CloseStream {
  void operator()(std::FILE* stream) const noexcept { std::fclose(stream); }
};

}  // namespace

Result<ClearImage> parse_png(const std::filesystem::path& file, std::span<const std::byte> bytes,
                             const ImageBounds& bounds, const Progress& progress) {
  PngBytes given{bytes, bytes.size(), progress, false};
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
