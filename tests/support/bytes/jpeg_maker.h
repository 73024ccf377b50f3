// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

namespace argil::test {

/// A JPEG by libjpeg's own compressor, in full colour resolution, and what one may do to its bytes.
struct JpegMaker {
  unsigned width = 0;
  unsigned height = 0;
  int channels = 3;  ///< 1 grey, 3 RGB, 4 CMYK
  int quality = 100;
  bool is_progressive = false;
  bool is_in_parts = false;  ///< a scan for each channel
  std::string exif = {};     ///< the content of a segment APP1

  /// `sample(x, y, channel)`: 0 to 255.
  template <class Sample>
  std::string jpeg(const Sample& sample) const {
    jpeg_compress_struct info{};
    jpeg_error_mgr faults{};
    info.err = jpeg_std_error(&faults);  // which ends the program: tests ask for what can be made
    jpeg_create_compress(&info);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &bytes, &size);
    set(info);
    jpeg_start_compress(&info, TRUE);
    if (!exif.empty()) {
      jpeg_write_marker(&info, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(exif.data()),
                        static_cast<unsigned>(exif.size()));
    }
    std::vector<JSAMPLE> row;
    for (unsigned y = 0; y < height; ++y) {
      row.clear();
      for (unsigned x = 0; x < width; ++x) {
        for (int c = 0; c < channels; ++c) row.push_back(static_cast<JSAMPLE>(sample(x, y, c)));
      }
      JSAMPROW rows[1] = {row.data()};
      jpeg_write_scanlines(&info, rows, 1);
    }
    jpeg_finish_compress(&info);
    std::string made(reinterpret_cast<const char*>(bytes), size);
    jpeg_destroy_compress(&info);
    std::free(bytes);
    return made;
  }

  /// A segment with the one tag that says how the image lies.
  static std::string exif_of(int orientation, bool is_little = false) {
    const auto number = [&](std::uint32_t value, int size) {
      std::string text;
      for (int n = 0; n < size; ++n) {
        const int byte = is_little ? n : size - 1 - n;
        text.push_back(static_cast<char>(value >> static_cast<unsigned>(8 * byte)));
      }
      return text;
    };
    std::string all("Exif\0\0", 6);
    all += is_little ? "II" : "MM";
    all += number(42, 2) + number(8, 4) + number(2, 2);
    all += number(0x010F, 2) + number(2, 2) + number(1, 4) + std::string(4, '\0');  // its maker
    all += number(0x0112, 2) + number(3, 2) + number(1, 4);
    all += number(static_cast<std::uint32_t>(orientation), 2) + number(0, 2);
    return all + number(0, 4);
  }

  /// Where the frame's header begins, at its marker: FF, C0 to C2.
  static std::size_t frame_at(const std::string& jpeg) {
    std::size_t at = 2;
    while (true) {
      const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(jpeg.at(at + n)); };
      if (byte(1) >= 0xC0 && byte(1) <= 0xC2) return at;
      at += 2 + 256U * byte(2) + byte(3);
    }
  }
  static std::string with_sides(std::string jpeg, unsigned width, unsigned height) {
    const std::size_t at = frame_at(jpeg);
    const std::array<unsigned, 4> bytes{height >> 8U, height & 255U, width >> 8U, width & 255U};
    for (std::size_t n = 0; n < 4; ++n) jpeg.at(at + 5 + n) = static_cast<char>(bytes[n]);
    return jpeg;
  }
  static std::string with_bits(std::string jpeg, int bits) {
    jpeg.at(frame_at(jpeg) + 4) = static_cast<char>(bits);
    return jpeg;
  }
  static std::string with_frame(std::string jpeg, unsigned marker) {
    jpeg.at(frame_at(jpeg) + 1) = static_cast<char>(marker);
    return jpeg;
  }

 private:
  void set(jpeg_compress_struct& info) const {
    info.image_width = width;
    info.image_height = height;
    info.input_components = channels;
    info.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    for (int c = 0; c < channels; ++c) {
      info.comp_info[c].h_samp_factor = 1;
      info.comp_info[c].v_samp_factor = 1;
    }
    if (is_progressive) jpeg_simple_progression(&info);
    if (!is_in_parts) return;
    static constexpr std::array<jpeg_scan_info, 3> kParts{
        {{1, {0}, 0, 63, 0, 0}, {1, {1}, 0, 63, 0, 0}, {1, {2}, 0, 63, 0, 0}}};
    info.scan_info = kParts.data();
    info.num_scans = channels;
  }
};

}  // namespace argil::test
