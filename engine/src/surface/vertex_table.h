// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace argil {

/// Vertices by keys: open addressing.
class VertexTable {
 public:
  /// `keys`: so many it holds without growing.
  explicit VertexTable(std::size_t keys = 128);
  void clear();
  /// The vertex of `key`, or `fresh` when there was none, which then is it.
  std::uint32_t find_or_insert(std::uint64_t key, std::uint32_t fresh);

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t vertex = 0;
    std::uint32_t round = 0;  ///< that of the table when it was filled; else it is empty
  };
  void grow();
  Slot& slot_of(std::uint64_t key);

  std::vector<Slot> slots_;  ///< a power of two, at least twice as many as are filled
  std::size_t filled_ = 0;
  std::uint32_t round_ = 1;
};

}  // namespace argil
