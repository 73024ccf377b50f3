// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace argil {

/// Of a leaf the rows within two of one that moved: in it, before and behind it along x, and before
/// and behind it along y. Bit 8 x + y. Those beside a row along z are the caller's to add.
inline std::uint64_t rows_reading(std::uint64_t own, std::uint64_t before_x, std::uint64_t behind_x,
                                  std::uint64_t before_y, std::uint64_t behind_y) noexcept {
  constexpr std::uint64_t kEach = 0x0101010101010101ULL;  // row along y of every x
  const std::uint64_t along_x = own << 8 | own << 16 | own >> 8 | own >> 16 | before_x >> 48 |
                                before_x >> 56 | behind_x << 48 | behind_x << 56;
  const std::uint64_t along_y = (own & 0x7f * kEach) << 1 | (own & 0x3f * kEach) << 2 |
                                (own >> 1 & 0x7f * kEach) | (own >> 2 & 0x3f * kEach) |
                                (before_y >> 6 & 0x03 * kEach) | (before_y >> 7 & kEach) |
                                (behind_y & 0x03 * kEach) << 6 | (behind_y & kEach) << 7;
  return own | along_x | along_y;
}

}  // namespace argil
