// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks of a PNG, by its specification (W3C, 2003), 5.3: a length, a name of four letters, so many
// bytes, and the CRC of name and bytes; numbers have their high byte first.
#include "format/png_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <string_view>
#include <utility>

#include <zlib.h>

namespace argil::io {
namespace {

constexpr std::size_t kPngSignature = 8;
constexpr std::size_t kAroundChunk = 12;  // its length, name and CRC
constexpr std::string_view kTextChunk = "tEXt";

void append_number(std::string& bytes, std::uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>(number >> shift & 0xFFU);
  }
}

std::uint32_t chunk_crc(std::string_view name_and_data) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(name_and_data.data()), name_and_data.size()));
}

std::uint32_t chunk_number(std::string_view bytes, std::size_t at) {
  assert(at + 4 <= bytes.size());
  std::uint32_t number = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    number = number << 8U | static_cast<unsigned char>(bytes[at + n]);
  }
  return number;
}

bool is_latin_letter(char c) noexcept {
  const auto code = static_cast<unsigned char>(c);
  return (code >= 32 && code <= 126) || code >= 161;
}

std::string text_chunk(const PngText& text) {
  const std::string data = text.key + '\0' + text.text;
  std::string chunk;
  append_number(chunk, static_cast<std::uint32_t>(data.size()));
  chunk.append(kTextChunk).append(data);
  append_number(chunk, chunk_crc(std::string_view(chunk).substr(4)));
  return chunk;
}

}  // namespace

bool is_png_text(const PngText& text) noexcept {
  constexpr std::size_t kMostOfAKey = 79;
  constexpr std::size_t kMostOfAText = std::size_t{1} << 30U;  // below what a length can name
  const std::string& key = text.key;
  if (key.empty() || key.size() > kMostOfAKey || text.text.size() > kMostOfAText) return false;
  if (key.front() == ' ' || key.back() == ' ') return false;
  return std::all_of(key.begin(), key.end(), is_latin_letter) &&
         text.text.find('\0') == std::string::npos;
}

std::vector<std::byte> with_texts(std::vector<std::byte> png, const std::vector<PngText>& texts) {
  constexpr std::size_t kHeaderEnd = kPngSignature + kAroundChunk + 13;  // IHDR is the first chunk
  assert(png.size() > kHeaderEnd);
  std::string chunks;
  for (const PngText& text : texts) {
    assert(is_png_text(text));
    chunks += text_chunk(text);
  }
  const auto* begin = reinterpret_cast<const std::byte*>(chunks.data());
  png.insert(png.begin() + static_cast<std::ptrdiff_t>(kHeaderEnd), begin, begin + chunks.size());
  return png;
}

std::vector<std::span<const std::byte>> pixel_parts(std::span<const std::byte> png) {
  constexpr std::array<std::string_view, 9> kOfPixels = {"IHDR", "PLTE", "IDAT", "IEND", "tRNS",
                                                         "gAMA", "cHRM", "sRGB", "iCCP"};
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
  std::vector<std::span<const std::byte>> parts;
  std::size_t begin = 0;  // of what is kept together
  std::size_t at = std::min(kPngSignature, bytes.size());
  while (bytes.size() - at >= kAroundChunk) {
    const std::size_t length = chunk_number(bytes, at);
    if (length > bytes.size() - at - kAroundChunk) break;
    const std::size_t end = at + kAroundChunk + length;
    if (std::ranges::find(kOfPixels, bytes.substr(at + 4, 4)) == kOfPixels.end()) {
      if (at > begin) parts.push_back(png.subspan(begin, at - begin));
      begin = end;
    }
    at = end;
  }
  if (bytes.size() > begin) parts.push_back(png.subspan(begin));
  return parts;
}

std::optional<std::vector<PngText>> texts_of(std::span<const std::byte> png) {
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
  std::vector<PngText> texts;
  std::size_t at = kPngSignature;
  while (at < bytes.size()) {
    if (bytes.size() - at < kAroundChunk) return std::nullopt;
    const std::size_t length = chunk_number(bytes, at);
    if (length > bytes.size() - at - kAroundChunk) return std::nullopt;
    const std::string_view chunk = bytes.substr(at + 4, 4 + length);
    at += kAroundChunk + length;
    if (chunk.starts_with("IEND")) break;
    if (!chunk.starts_with(kTextChunk)) continue;
    if (chunk_crc(chunk) != chunk_number(bytes, at - 4)) return std::nullopt;
    const std::string_view data = chunk.substr(4);
    const std::size_t end = data.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    texts.push_back({std::string(data.substr(0, end)), std::string(data.substr(end + 1))});
  }
  return texts;
}

}  // namespace argil::io
