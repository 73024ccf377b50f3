// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace argil::viewer {

/// As messages show names. Appends, because GCC 12 warns of a copy onto itself for "'" + text.
inline std::string in_quotes(const std::string& text) {
  std::string result(1, '\'');
  result += text;
  return result += '\'';
}

}  // namespace argil::viewer
