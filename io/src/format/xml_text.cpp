// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/xml_text.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

namespace argil::io {
namespace {

constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
    {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};

bool is_character(std::uint32_t code) noexcept {
  return code > 0 && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

/// UTF-8 of a character.
void append_character(std::uint32_t code, std::string& text) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
  const auto more = [&](int shift) { byte(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0U | code >> 6U);
  } else if (code < 0x10000) {
    byte(0xE0U | code >> 12U);
    more(6);
  } else {
    byte(0xF0U | code >> 18U);
    more(12);
    more(6);
  }
  more(0);
}

/// The character that "#65" or "#x41" names.
std::optional<std::uint32_t> numbered_character(std::string_view entity) {
  if (!entity.starts_with('#')) return std::nullopt;
  entity.remove_prefix(1);
  const bool is_hex = entity.starts_with('x');
  if (is_hex) entity.remove_prefix(1);
  std::uint32_t code = 0;
  const auto [end, error] =
      std::from_chars(entity.data(), entity.data() + entity.size(), code, is_hex ? 16 : 10);
  const bool is_whole = error == std::errc() && end == entity.data() + entity.size();
  return is_whole && is_character(code) ? std::optional(code) : std::nullopt;
}

bool append_entity(std::string_view entity, std::string& text) {
  for (const auto& [name, character] : kEntities) {
    if (entity != name) continue;
    text += character;
    return true;
  }
  const auto code = numbered_character(entity);
  if (code) append_character(*code, text);
  return code.has_value();
}

/// How many bytes of `text` are one character of UTF-8; 0 for none.
std::size_t character_bytes(std::string_view text) noexcept {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || bytes > text.size()) return 0;
  std::uint32_t code = first & (0xFFU >> (bytes + 1));
  for (std::size_t at = 1; at < bytes; ++at) {
    if ((byte(at) & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (byte(at) & 0x3FU);
  }
  // Longer than need be, or half of a pair of UTF-16.
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  return code >= kLeast[bytes] && is_character(code) ? bytes : 0;
}

}  // namespace

std::string xml_unescaped(std::string_view text) {
  constexpr std::size_t kLongestEntity = 12;
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end =
        text[at] == '&' ? text.substr(at, kLongestEntity).find(';') : std::string_view::npos;
    if (end != std::string_view::npos && append_entity(text.substr(at + 1, end - 1), plain)) {
      at += end;
    } else {
      plain += text[at];
    }
  }
  return plain;
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        // XML 1.0 has no other control characters, not even escaped.
        escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return escaped;
}

std::string plain_name(std::string_view text, std::size_t most_bytes) {
  constexpr char kDelete = 0x7F;
  std::string name;
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    const bool is_control =
        bytes == 1 && (static_cast<unsigned char>(text[0]) < ' ' || text[0] == kDelete);
    const std::string_view character = bytes == 0 ? "?" : is_control ? " " : text.substr(0, bytes);
    if (name.size() + character.size() > most_bytes) break;
    if (!name.empty() || character != " ") name += character;
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  while (name.ends_with(' ')) name.pop_back();
  return name;
}

}  // namespace argil::io
