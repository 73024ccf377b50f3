// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace argil::test {

/// A PNG of any kind, packed without compression, byte by byte as its specification says.
struct PngMaker {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 8;   ///< of a channel
  int color = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
  bool is_interlaced = false;
  std::string palette = {};  ///< RGB, RGB, ...
  std::string clear = {};    ///< a tRNS chunk
  std::string gamma = {};    ///< a gAMA chunk

  /// `sample(x, y, channel)`: of so many bits.
  template <class Sample>
  std::string png(const Sample& sample) const {
    return png_of_rows(rows(sample));
  }

  /// Around rows that are packed already, each behind its filter's number.
  std::string png_of_rows(const std::string& rows) const {
    std::string head = number(width) + number(height);
    head += {static_cast<char>(bits), static_cast<char>(color), 0, 0,
             static_cast<char>(is_interlaced ? 1 : 0)};
    std::string all = "\x89PNG\r\n\x1a\n" + chunk("IHDR", head);
    if (!gamma.empty()) all += chunk("gAMA", gamma);
    if (!palette.empty()) all += chunk("PLTE", palette);
    if (!clear.empty()) all += chunk("tRNS", clear);
    return all + chunk("IDAT", stored(rows)) + chunk("IEND", "");
  }

  static std::string number(std::uint32_t value) {
    return {static_cast<char>(value >> 24U), static_cast<char>(value >> 16U),
            static_cast<char>(value >> 8U), static_cast<char>(value)};
  }

  static std::string chunk(std::string_view kind, const std::string& data) {
    const std::string body = std::string(kind) + data;
    return number(static_cast<std::uint32_t>(data.size())) + body + number(crc_of(body));
  }

 private:
  struct Pass {
    std::uint32_t x, y, step_x, step_y;
  };

  template <class Sample>
  std::string rows(const Sample& sample) const {
    // Adam7, and all at once.
    constexpr std::array<Pass, 7> kPasses{{{0, 0, 8, 8},
                                           {4, 0, 8, 8},
                                           {0, 4, 4, 8},
                                           {2, 0, 4, 4},
                                           {0, 2, 2, 4},
                                           {1, 0, 2, 2},
                                           {0, 1, 1, 2}}};
    std::string all;
    if (!is_interlaced) return rows_of({0, 0, 1, 1}, sample);
    for (const Pass& pass : kPasses) all += rows_of(pass, sample);
    return all;
  }

  template <class Sample>
  std::string rows_of(const Pass& pass, const Sample& sample) const {
    const int channels = color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1;
    std::string all;
    if (pass.x >= width) return all;
    for (std::uint32_t y = pass.y; y < height; y += pass.step_y) {
      all += '\0';  // no filter
      unsigned held = 0;
      int count = 0;
      for (std::uint32_t x = pass.x; x < width; x += pass.step_x) {
        for (int channel = 0; channel < channels; ++channel) {
          const auto value = static_cast<unsigned>(sample(x, y, channel));
          if (bits == 16) all += static_cast<char>(value >> 8U);
          held = held << static_cast<unsigned>(bits) | value;
          count += bits;
          if (count < 8) continue;
          all += static_cast<char>(held);
          held = 0;
          count = 0;
        }
      }
      if (count > 0) all += static_cast<char>(held << static_cast<unsigned>(8 - count));
    }
    return all;
  }

  static std::uint32_t crc_of(std::string_view bytes) {
    std::uint32_t crc = 0xffffffffU;
    for (const char byte : bytes) {
      crc ^= static_cast<unsigned char>(byte);
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
    return ~crc;
  }

  /// A stream of zlib in blocks that are stored as they are.
  static std::string stored(std::string_view rows) {
    std::string all = "\x78\x01";
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char byte : rows) {
      a = (a + static_cast<unsigned char>(byte)) % 65521U;
      b = (b + a) % 65521U;
    }
    while (true) {
      const std::string_view block = rows.substr(0, std::min<std::size_t>(rows.size(), 65535));
      rows.remove_prefix(block.size());
      const auto size = static_cast<unsigned>(block.size());
      all +=
          {static_cast<char>(rows.empty() ? 1 : 0), static_cast<char>(size),
           static_cast<char>(size >> 8U), static_cast<char>(~size), static_cast<char>(~size >> 8U)};
      all += block;
      if (rows.empty()) return all + number(b << 16U | a);
    }
  }
};

}  // namespace argil::test
