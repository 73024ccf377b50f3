// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace argil::viewer {

/// As messages show names. Appends, because GCC 12 warns of a copy onto itself for "'" + text.
inline std::string in_quotes(const std::string& text) {
  std::string result(1, '\'');
  result += text;
  return result += '\'';
}

/// A file's extension in lower case: ".vdb" of OWL.VDB. Letters beyond ASCII stay as they are.
std::string extension_of(const std::filesystem::path& file);

/// Whether a file's extension is that of an image which may be read: PNG or JPEG, in any case.
bool has_image_ending(const std::filesystem::path& file);

/// Digits in groups of three: 1 234 567.
std::string grouped(std::int64_t number);

/// A time of the local clock, formatted as strftime formats it.
std::string clock_text(std::chrono::system_clock::time_point when, const char* format);

}  // namespace argil::viewer
