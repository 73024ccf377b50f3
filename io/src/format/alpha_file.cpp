// SPDX-License-Identifier: GPL-3.0-or-later
// PNG by libpng's own interface: the simplified one would bend values by the file's gamma. libpng
// leaves a call by longjmp where something is wrong, so its calls stand in functions that own
// nothing: what they fill is a member.
#include "argil/io/alpha_file.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <png.h>

#include "argil/core/hash.h"
#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/file_error.h"
#include "format/image_format.h"
#include "format/jpeg_read.h"

namespace argil::io {
namespace {

constexpr ImageBounds kAlphaBounds{AlphaImage::kLeastSide, AlphaImage::kMostSide,
                                   std::int64_t{AlphaImage::kMostSide} * AlphaImage::kMostSide};

/// Of channels up to 65535.
std::uint16_t luma_of(std::uint32_t red, std::uint32_t green, std::uint32_t blue) noexcept {
  return static_cast<std::uint16_t>((2126 * red + 7152 * green + 722 * blue + 5000) / 10000);
}

/// Takes a message and leaves libpng.
[[noreturn]] void give_up(png_structp png, png_const_charp words) {
  auto* reason = static_cast<std::array<char, 128>*>(png_get_error_ptr(png));
  std::strncpy(reason->data(), words, reason->size() - 1);
  png_longjmp(png, 1);
}

/// What is odd but can be read is read.
void pass_over(png_structp, png_const_charp) {}

/// One PNG in memory.
class PngReader {
 public:
  explicit PngReader(std::span<const std::byte> bytes)
      : left_(bytes),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &reason_, give_up, pass_over)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool is_ready() const noexcept { return info_ != nullptr; }
  const char* reason() const noexcept { return reason_.data(); }

  /// False where libpng gave up, here and below.
  bool read_size() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, take);
    // Pixels alone are wanted: no chunk of text or colours may ask for memory.
    constexpr png_uint_32 kNoLimit = 0x7fffffff;  // the sides are judged by who asks
    png_set_user_limits(png_, kNoLimit, kNoLimit);
    png_set_chunk_malloc_max(png_, 1U << 20U);
    png_set_chunk_cache_max(png_, 16);
    png_read_info(png_, info_);
    width_ = png_get_image_width(png_, info_);
    height_ = png_get_image_height(png_, info_);
    return true;
  }

  /// All pixels, of 8 or 16 bits a channel; after read_size().
  bool start_pixels() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    const int color = png_get_color_type(png_, info_);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (color == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png_);
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    row_bytes_ = png_get_rowbytes(png_, info_);
    channels_ = png_get_channels(png_, info_);
    bits_ = png_get_bit_depth(png_, info_);
    return true;
  }

  /// `rows`: room for all of them where there are several passes, else for one.
  bool read_row(png_bytep row) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row, nullptr);
    return true;
  }
  bool read_end() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_end(png_, nullptr);
    return true;
  }

  std::uint32_t width() const noexcept { return width_; }
  std::uint32_t height() const noexcept { return height_; }
  int passes() const noexcept { return passes_; }
  std::size_t row_bytes() const noexcept { return row_bytes_; }

  /// A pixel of a row as a height.
  std::uint16_t grey(const std::uint8_t* row, std::size_t x) const noexcept {
    const auto value = [&](std::size_t channel) -> std::uint32_t {
      const std::size_t at = x * static_cast<std::size_t>(channels_) + channel;
      if (bits_ == 16) return static_cast<std::uint32_t>(row[2 * at] << 8 | row[2 * at + 1]);
      return row[at] * 257U;
    };
    const bool is_color = channels_ >= 3;
    std::uint32_t grey = value(0);
    if (is_color) grey = luma_of(value(0), value(1), value(2));
    const bool is_clear = channels_ == 2 || channels_ == 4;
    if (is_clear) grey = (grey * value(is_color ? 3 : 1) + 32767) / 65535;
    return static_cast<std::uint16_t>(grey);
  }

 private:
  static void take(png_structp png, png_bytep to, std::size_t size) {
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > reader->left_.size()) png_error(png, "the file ends too early");
    std::memcpy(to, reader->left_.data(), size);
    reader->left_ = reader->left_.subspan(size);
  }

  std::span<const std::byte> left_;
  std::array<char, 128> reason_{};
  png_structp png_;
  png_infop info_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::size_t row_bytes_ = 0;
  int channels_ = 0;
  int bits_ = 0;
  int passes_ = 1;
};

/// False where libpng gave up.
bool read_pixels(PngReader& reader, const Pace& pace, std::vector<std::uint16_t>& pixels) {
  if (!reader.start_pixels()) return false;
  const bool is_interlaced = reader.passes() > 1;
  std::vector<std::uint8_t> rows(reader.row_bytes() * (is_interlaced ? reader.height() : 1));
  pixels.reserve(static_cast<std::size_t>(reader.width()) * reader.height());
  for (int pass = 0; pass < reader.passes(); ++pass) {
    for (std::size_t y = 0; y < reader.height(); ++y) {
      pace.at((pass + static_cast<double>(y) / reader.height()) / reader.passes());
      std::uint8_t* row = rows.data() + (is_interlaced ? y * reader.row_bytes() : 0);
      if (!reader.read_row(row)) return false;
      if (pass + 1 < reader.passes()) continue;
      for (std::size_t x = 0; x < reader.width(); ++x) pixels.push_back(reader.grey(row, x));
    }
  }
  return reader.read_end();
}

/// Heights of a PNG's pixels, as they stand in the file.
Result<std::vector<std::uint16_t>> parse_png_heights(const std::filesystem::path& file,
                                                     std::span<const std::byte> bytes,
                                                     const Pace& pace, int& width, int& height) {
  PngReader reader(bytes);
  if (!reader.is_ready()) throw std::bad_alloc();
  if (!reader.read_size()) return damaged_image_error(file, reader.reason());
  if (auto fits = check_sides(file, reader.width(), reader.height(), kAlphaBounds); !fits) {
    return fits.error();
  }
  width = static_cast<int>(reader.width());
  height = static_cast<int>(reader.height());
  std::vector<std::uint16_t> pixels;
  if (!read_pixels(reader, pace, pixels)) return damaged_image_error(file, reader.reason());
  return pixels;
}

/// Those of a JPEG, which has eight bits and no opacity.
Result<std::vector<std::uint16_t>> parse_jpeg_heights(const std::filesystem::path& file,
                                                      std::span<const std::byte> bytes,
                                                      const Progress& progress, int& width,
                                                      int& height) {
  const auto image = parse_jpeg(file, bytes, kAlphaBounds, progress);
  if (!image) return image.error();
  width = image.value().width;
  height = image.value().height;
  const std::vector<std::uint8_t>& rgba = image.value().rgba;
  std::vector<std::uint16_t> pixels;
  pixels.reserve(rgba.size() / 4);
  for (std::size_t n = 0; n < rgba.size(); n += 4) {
    const auto value = [&](std::size_t channel) { return rgba[n + channel] * 257U; };
    pixels.push_back(luma_of(value(0), value(1), value(2)));
  }
  return pixels;
}

Result<std::shared_ptr<const AlphaImage>> parse_alpha(const std::filesystem::path& file,
                                                      std::span<const std::byte> bytes,
                                                      const Progress& progress) {
  const Pace pace(progress, "read");
  int width = 0;
  int height = 0;
  const ImageFormat format = image_format_of(bytes);
  if (format == ImageFormat::none) return no_image_error(file);
  auto pixels = format == ImageFormat::png
                    ? parse_png_heights(file, bytes, pace, width, height)
                    : parse_jpeg_heights(file, bytes, progress, width, height);
  if (!pixels) return pixels.error();
  auto made = AlphaImage::make(width, height, std::move(pixels).value());
  if (!made) return file_error(made.error().kind, file, ": " + made.error().message);
  return made;
}

}  // namespace

Result<std::shared_ptr<const AlphaImage>> read_alpha(const std::filesystem::path& file,
                                                     const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<std::shared_ptr<const AlphaImage>> {
    const auto bytes = read_file_bytes(file, progress);
    if (!bytes) return bytes.error();
    return parse_alpha(file, bytes.value(), progress);
  });
}

namespace {

/// Appends what libpng packs; no exception may pass it.
void append_packed(png_structp png, png_bytep data, std::size_t size) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bool is_kept = true;
  try {
    bytes->insert(bytes->end(), data, data + size);
  } catch (const std::bad_alloc&) {
    is_kept = false;
  }
  if (!is_kept) png_error(png, "not enough memory");
}

/// False where libpng gave up. Nothing here has a destructor that its longjmp would skip.
bool pack_rows(png_structp png, png_infop info, const AlphaImage& image,
               std::vector<std::uint8_t>& row) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width()),
               static_cast<png_uint_32>(image.height()), 16, PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const auto width = static_cast<std::size_t>(image.width());
  for (std::size_t n = 0; n < image.pixels().size(); ++n) {
    const std::size_t x = n % width;
    row[2 * x] = static_cast<std::uint8_t>(image.pixels()[n] >> 8U);
    row[2 * x + 1] = static_cast<std::uint8_t>(image.pixels()[n] & 0xffU);
    if (x + 1 == width) png_write_row(png, row.data());
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<void> write_alpha(const std::filesystem::path& file, const AlphaImage& image) {
  return no_throw(file.string(), [&]() -> Result<void> {
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> row(2 * static_cast<std::size_t>(image.width()));
    std::array<char, 128> reason{};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &reason, give_up, pass_over);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    bool is_packed = info != nullptr;
    if (is_packed) {
      png_set_write_fn(png, &bytes, append_packed, nullptr);
      is_packed = pack_rows(png, info, image, row);
    }
    png_destroy_write_struct(&png, &info);
    // A grey image of these sides is never refused.
    if (!is_packed) throw std::bad_alloc();
    return replace_file(file, [&](const std::filesystem::path& temporary) {
      OutputFile out(temporary);
      out.write(bytes.data(), bytes.size());
      return out.close();
    });
  });
}

std::string alpha_hash(const AlphaImage& image) {
  Hash64 hash;
  const std::array<std::int32_t, 2> sides{image.width(), image.height()};
  hash.update(std::as_bytes(std::span(sides)));
  hash.update(std::as_bytes(std::span(image.pixels())));
  return hash_text(hash.digest());
}

}  // namespace argil::io
