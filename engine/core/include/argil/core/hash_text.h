// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

#include "argil/core/hash.h"

namespace argil {

/// A hash as files show it: 16 hexadecimal digits in lower case, leading zeros kept, so that two
/// hashes can be compared as text. The most significant digit comes first whatever the machine's
/// byte order, as xxHash's own tool prints it.
///
/// Threads      any; allocates the string.
inline std::string hash_text(std::uint64_t hash) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

/// The Hash64 of the characters, without a terminating zero.
///
/// Shapes       any length, empty too; any bytes: nothing is taken for a line end or a character of
///              more than one byte.
/// Threads      any; does not allocate.
inline std::uint64_t hash_of_text(std::string_view text) {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(text.data(), text.size())));
  return hash.digest();
}

}  // namespace argil
