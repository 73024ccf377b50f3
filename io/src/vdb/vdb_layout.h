// SPDX-License-Identifier: GPL-3.0-or-later
// What a VDB file of format 224 is made of, as OpenVDB 10 writes and reads it: io/Archive, Grid,
// Transform, RootNode, InternalNode and LeafNode put it one after the other.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace argil::io {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

inline constexpr std::uint32_t kVdbFormat = 224;
inline constexpr std::size_t kUuidBytes = 36;

/// What of a node's inactive values is in the file.
enum ValueKind : std::uint8_t {
  kBackground = 0,
  kMinusBackground = 1,
  kOneOther = 2,
  kChosenOfBackground = 3,  ///< by a mask, either sign
  kChosenOneOther = 4,      ///< by a mask, the background or another
  kChosenOfTwo = 5,         ///< by a mask
  kAll = 6,
};

/// How the values of a grid's nodes are written.
enum Compression : std::uint32_t {
  kZip = 1,
  kActiveMask = 2,  ///< only active ones, where no more than two others are there
  kBlosc = 4,
};

}  // namespace argil::io
