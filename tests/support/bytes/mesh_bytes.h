// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace argil::test {

/// A GLB around this JSON and this binary chunk.
inline std::string glb_file(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto number = [](std::size_t value) {
    std::string bytes(4, '\0');
    for (std::size_t k = 0; k < 4; ++k) bytes[k] = static_cast<char>(value >> (8 * k) & 255U);
    return bytes;
  };
  return "glTF" + number(2) + number(28 + json.size() + binary.size()) + number(json.size()) +
         "JSON" + json + number(binary.size()) + std::string("BIN\0", 4) + binary;
}

/// The bytes of numbers, one after the other.
template <class Number, class... More>
std::string bytes_of(Number first, More... more) {
  std::string bytes;
  const auto put = [&](Number value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(first);
  (put(static_cast<Number>(more)), ...);
  return bytes;
}

/// RFC 4648.
inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_there = n + k < bytes.size();
      three = three << 8U | (is_there ? static_cast<unsigned char>(bytes[n + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += n + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

/// The same text in UTF-16 with its mark, the higher byte first or last.
inline std::string utf16(std::string_view ascii, bool higher_first) {
  std::string bytes = higher_first ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (higher_first) bytes += '\0';
    bytes += c;
    if (!higher_first) bytes += '\0';
  }
  return bytes;
}

}  // namespace argil::test
