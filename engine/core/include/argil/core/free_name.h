// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string>
#include <string_view>

namespace argil {

/// `base`, or with the first number from 2 behind it that makes a name which is free; `base` is cut
/// where the number needs room, never within a letter of UTF-8.
///
/// Shapes  base: at most `most_bytes`, of which the number needs some, so 21 at least.
///         is_taken(name): false for some number.
template <class IsTaken>
std::string free_name(std::string_view base, std::size_t most_bytes, const IsTaken& is_taken) {
  assert(base.size() <= most_bytes && most_bytes > 20);
  std::string name(base);
  for (int n = 2; is_taken(name); ++n) {
    const std::string number = std::to_string(n).insert(0, 1, ' ');
    std::size_t kept = std::min(base.size(), most_bytes - number.size());
    const auto is_within_letter = [&] {
      return kept < base.size() && (static_cast<unsigned char>(base[kept]) & 0xC0U) == 0x80U;
    };
    while (kept > 0 && is_within_letter()) --kept;
    name = std::string(base.substr(0, kept)) + number;
  }
  return name;
}

}  // namespace argil
