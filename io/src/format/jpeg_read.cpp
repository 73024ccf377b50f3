// SPDX-License-Identifier: GPL-3.0-or-later
// JPEG by libjpeg-turbo. As libpng it leaves a call by longjmp where something is wrong, so its
// calls stand in functions that own nothing: what they fill is a member.
#include "format/jpeg_read.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

// What jerror.h has depends on what jpeglib.h includes.
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include "argil/core/pace.h"

#include "format/exif.h"

namespace argil::io {
namespace {

constexpr int kMostJpegScans = 100;  // a progressive one has about ten, and each costs a pass
constexpr int kJpegEndsEarly = -1;   // beside libjpeg's numbers, which are positive
constexpr int kJpegStopped = -2;
constexpr int kJpegTooManyScans = -3;

/// One JPEG in memory.
class JpegReader {
 public:
  JpegReader(std::span<const std::byte> bytes, const Progress& progress)
      : progress_(progress), size_(bytes.size()) {
    std::memset(&info_, 0, sizeof info_);
    info_.err = jpeg_std_error(&faults_);
    info_.client_data = this;
    faults_.error_exit = give_up;
    faults_.emit_message = judge;
    faults_.output_message = [](j_common_ptr) {};  // libjpeg would print it
    source_.next_input_byte = reinterpret_cast<const JOCTET*>(bytes.data());
    source_.bytes_in_buffer = bytes.size();
    source_.init_source = [](j_decompress_ptr) {};
    // Also where only the mark of the end is missing: bits are read ahead as far as that.
    source_.fill_input_buffer = [](j_decompress_ptr info) -> boolean {
      leave(reinterpret_cast<j_common_ptr>(info), kJpegEndsEarly);
    };
    source_.skip_input_data = skip;
    source_.resync_to_restart = jpeg_resync_to_restart;
    source_.term_source = [](j_decompress_ptr) {};
    monitor_.progress_monitor = ask;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// False where libjpeg gave up, here and below.
  bool read_header() {
    if (setjmp(jump_) != 0) return false;
    jpeg_create_decompress(&info_);
    info_.src = &source_;
    info_.progress = &monitor_;
    constexpr unsigned kWhole = 0xFFFF;
    jpeg_save_markers(&info_, JPEG_APP0 + 1, kWhole);
    jpeg_read_header(&info_, TRUE);
    return true;
  }

  bool start_rows() {
    if (setjmp(jump_) != 0) return false;
    info_.out_color_space = JCS_EXT_RGBA;  // with full opacity
    jpeg_start_decompress(&info_);
    return true;
  }

  bool read_row(std::uint8_t* row) {
    if (setjmp(jump_) != 0) return false;
    JSAMPROW rows[1] = {row};
    jpeg_read_scanlines(&info_, rows, 1);
    return true;
  }

  std::size_t width() const noexcept { return info_.image_width; }
  std::size_t height() const noexcept { return info_.image_height; }
  bool is_cmyk() const noexcept {
    return info_.jpeg_color_space == JCS_CMYK || info_.jpeg_color_space == JCS_YCCK;
  }
  int orientation() const noexcept {
    for (const auto* marker = info_.marker_list; marker != nullptr; marker = marker->next) {
      const int found =
          exif_orientation({reinterpret_cast<const std::byte*>(marker->data), marker->data_length});
      if (found != 1) return found;
    }
    return 1;
  }

  /// libjpeg's number of what was wrong, or one of those above; and it in words.
  int code() const noexcept { return code_; }
  const char* words() const noexcept { return words_.data(); }

 private:
  static JpegReader& reader_of(j_common_ptr info) {
    return *static_cast<JpegReader*>(info->client_data);
  }

  [[noreturn]] static void leave(j_common_ptr info, int code) {
    JpegReader& reader = reader_of(info);
    reader.code_ = code;
    const char* const words = code == kJpegEndsEarly      ? "the file ends too early"
                              : code == kJpegTooManyScans ? "more than 100 scans"
                                                          : "";
    if (*words != '\0') std::strncpy(reader.words_.data(), words, reader.words_.size() - 1);
    std::longjmp(reader.jump_, 1);
  }

  [[noreturn]] static void give_up(j_common_ptr info) {
    info->err->format_message(info, reader_of(info).words_.data());
    leave(info, info->err->msg_code);
  }

  /// Of warnings those that tell of pixels which are lost; libjpeg would make some up.
  static void judge(j_common_ptr info, int level) {
    if (level >= 0) return;
    switch (info->err->msg_code) {
      case JWRN_HIT_MARKER:
      case JWRN_HUFF_BAD_CODE:
      case JWRN_ARITH_BAD_CODE:
      case JWRN_BOGUS_PROGRESSION:
      case JWRN_JPEG_EOF:
      case JWRN_MUST_RESYNC:
        give_up(info);
      default:
        break;
    }
  }

  static void skip(j_decompress_ptr info, long count) {
    if (count <= 0) return;
    const auto bytes = static_cast<std::size_t>(count);
    if (bytes > info->src->bytes_in_buffer) {
      leave(reinterpret_cast<j_common_ptr>(info), kJpegEndsEarly);
    }
    info->src->next_input_byte += bytes;
    info->src->bytes_in_buffer -= bytes;
  }

  /// Before each row, and each row of blocks of a progressive one.
  static void ask(j_common_ptr info) {
    const auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
    if (decoder->input_scan_number > kMostJpegScans) leave(info, kJpegTooManyScans);
    if (!reader_of(info).goes_on()) leave(info, kJpegStopped);
  }

  /// No exception may pass libjpeg.
  bool goes_on() noexcept {
    if (!progress_) return true;
    const double done = static_cast<double>(size_ - source_.bytes_in_buffer);
    return progress_("read", done / static_cast<double>(size_));
  }

  const Progress& progress_;
  std::size_t size_;
  jpeg_decompress_struct info_;
  jpeg_error_mgr faults_{};
  jpeg_source_mgr source_{};
  jpeg_progress_mgr monitor_{};
  std::jmp_buf jump_;
  std::array<char, JMSG_LENGTH_MAX> words_{};
  int code_ = 0;
};

/// Why it gave up.
Error jpeg_error(const std::filesystem::path& file, const JpegReader& reader,
                 const ImageBounds& bounds) {
  const auto error = [&](const std::string& what) {
    return file_error(ErrorKind::bad_input, file, what);
  };
  switch (reader.code()) {
    case kJpegStopped:
      throw Interrupted();
    case JERR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case JERR_BAD_PRECISION:
      return error(
          " is a JPEG of more than 8 bits a channel; save it with 8, or as a PNG, which may have "
          "16");
    case JERR_SOF_UNSUPPORTED:
    case JERR_ARITH_NOTIMPL:
    case JERR_CONVERSION_NOTIMPL:
      return error(std::string(" is a JPEG of a kind that is not read (")
                       .append(reader.words())
                       .append("); save it as a usual one, or as a PNG"));
    case JERR_IMAGE_TOO_BIG:
      return error(std::string(" is larger than 65500 pixels; each side may be ")
                       .append(std::to_string(bounds.most_side))
                       .append(" at most: make it smaller"));
    default:
      return damaged_image_error(file, reader.words());
  }
}

/// Where the pixels of a file's rows lie in the image as it is seen: that of column x and row y at
/// `first + x * along + y * down`.
struct SeenOrder {
  std::ptrdiff_t first = 0;
  std::ptrdiff_t along = 1;
  std::ptrdiff_t down = 0;
  bool is_turned = false;  ///< width and height change places
};

SeenOrder order_of(int orientation, std::ptrdiff_t width, std::ptrdiff_t height) {
  assert(orientation >= 1 && orientation <= 8);
  const std::ptrdiff_t last = width * height - 1;
  switch (orientation) {
    case 2:
      return {width - 1, -1, width, false};
    case 3:
      return {last, -1, -width, false};
    case 4:
      return {last - (width - 1), 1, -width, false};
    case 5:  // as it is seen, rows are of `height` pixels from here on
      return {0, height, 1, true};
    case 6:
      return {height - 1, height, -1, true};
    case 7:
      return {last, -height, -1, true};
    case 8:
      return {last - (height - 1), -height, 1, true};
    default:
      return {0, 1, width, false};
  }
}

}  // namespace

Result<ClearImage> parse_jpeg(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const ImageBounds& bounds, const Progress& progress) {
  constexpr std::size_t kChannels = 4;
  JpegReader reader(bytes, progress);
  if (!reader.read_header()) return jpeg_error(file, reader, bounds);
  const auto width = static_cast<std::ptrdiff_t>(reader.width());
  const auto height = static_cast<std::ptrdiff_t>(reader.height());
  if (auto fits = check_sides(file, width, height, bounds); !fits) return fits.error();
  if (reader.is_cmyk()) {
    return file_error(ErrorKind::bad_input, file,
                      " is a JPEG in CMYK, which are inks and no colours of a screen; save it in "
                      "RGB");
  }
  const SeenOrder order = order_of(reader.orientation(), width, height);
  if (!reader.start_rows()) return jpeg_error(file, reader, bounds);
  ClearImage image;
  image.width = static_cast<int>(order.is_turned ? height : width);
  image.height = static_cast<int>(order.is_turned ? width : height);
  image.rgba.resize(kChannels * reader.width() * reader.height());
  std::vector<std::uint8_t> row(kChannels * reader.width());
  for (std::ptrdiff_t y = 0; y < height; ++y) {
    const bool is_straight = order.along == 1;
    std::ptrdiff_t to = order.first + y * order.down;
    std::uint8_t* const at = image.rgba.data();
    const auto byte_of = [](std::ptrdiff_t pixel) {
      return kChannels * static_cast<std::size_t>(pixel);
    };
    if (!reader.read_row(is_straight ? at + byte_of(to) : row.data())) {
      return jpeg_error(file, reader, bounds);
    }
    for (std::ptrdiff_t x = 0; !is_straight && x < width; ++x, to += order.along) {
      std::memcpy(at + byte_of(to), row.data() + byte_of(x), kChannels);
    }
  }
  return image;
}

}  // namespace argil::io
