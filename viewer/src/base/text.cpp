// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <algorithm>
#include <cassert>
#include <ctime>

namespace argil::viewer {

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  // Not std::tolower: what it does depends on the locale.
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

bool has_image_ending(const std::filesystem::path& file) {
  const std::string ending = extension_of(file);
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

std::string grouped(std::int64_t number) {
  assert(number >= 0);
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

std::string clock_text(std::chrono::system_clock::time_point when, const char* format) {
  assert(format != nullptr);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(when);
  std::tm local{};
  localtime_r(&seconds, &local);
  char text[64];
  const std::size_t letters = std::strftime(text, sizeof text, format, &local);
  return {text, letters};
}

}  // namespace argil::viewer
