// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace argil::haptics {

/// From 0 to below 1, the next of `state`. SplitMix64 (Steele, Lea, Flood 2014): any seed will do.
inline double unit_random(std::uint64_t& state) noexcept {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  z ^= z >> 31U;
  return static_cast<double>(z >> 11U) * 0x1p-53;
}

}  // namespace argil::haptics
