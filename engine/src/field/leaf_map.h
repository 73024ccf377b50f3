// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "field/level_stack.h"

namespace argil {

/// A value for each of some leaves of a level, stored there or not, in chunks of 8^3 leaves, since
/// what is asked for lies together: several times faster than an entry each. A leaf that was never
/// given one has T{}. Reading with `get` is thread-safe while nobody writes.
template <class T>
class LeafMap {
 public:
  LeafMap() = default;
  LeafMap(LeafMap&&) noexcept = default;
  LeafMap& operator=(LeafMap&&) noexcept = default;

  /// The value of a leaf, to be written.
  T& at(const Coord& origin) {
    assert(is_leaf_origin(origin));
    const Coord key = origin >> kChunkShift;
    if (last_ == nullptr || key != last_key_) {
      last_ = &chunks_[key];
      last_key_ = key;
    }
    return (*last_)[offset(origin)];
  }

  /// Of the leaf that `node` belongs to.
  T get(const Coord& node) const {
    const auto chunk = chunks_.find(node >> kChunkShift);
    return chunk == chunks_.end() ? T{} : chunk->second[offset(node)];
  }

  /// As `get`, for somebody who asks for leaves that lie together: keeps the last chunk. For one
  /// thread, while nobody writes.
  class Reader {
   public:
    explicit Reader(const LeafMap& map) noexcept : map_(&map) {}
    T get(const Coord& node) {
      const Coord key = node >> kChunkShift;
      if (!is_known_ || key != key_) {
        const auto found = map_->chunks_.find(key);
        chunk_ = found == map_->chunks_.end() ? nullptr : &found->second;
        key_ = key;
        is_known_ = true;
      }
      return chunk_ == nullptr ? T{} : (*chunk_)[offset(node)];
    }

   private:
    const LeafMap* map_;
    const std::array<T, kLeafNodes>* chunk_ = nullptr;
    Coord key_;
    bool is_known_ = false;
  };

  /// Calls visit(origin, value) for every value that is not T{}; the order is that of the chunks,
  /// and the same whatever order they were written in.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::vector<Coord> keys;
    keys.reserve(chunks_.size());
    for (const auto& entry : chunks_) keys.push_back(entry.first);
    std::sort(keys.begin(), keys.end());
    for (const Coord& key : keys) {
      const Chunk& chunk = chunks_.find(key)->second;
      const Coord first = key << kChunkShift;
      for (int n = 0; n < kLeafNodes; ++n) {
        const T& value = chunk[static_cast<std::size_t>(n)];
        if (value != T{}) {
          visit(first + Coord((n >> 6) * kLeafSide, (n >> 3 & 7) * kLeafSide, (n & 7) * kLeafSide),
                value);
        }
      }
    }
  }

  /// What the chunks take, about.
  std::int64_t bytes() const noexcept {
    return static_cast<std::int64_t>(chunks_.size() * (sizeof(Chunk) + sizeof(Coord) + 16));
  }

  void clear() {
    chunks_.clear();
    last_ = nullptr;
  }

 private:
  static constexpr int kChunkShift = 6;  // 8 leaves of 8 nodes
  using Chunk = std::array<T, kLeafNodes>;

  static std::size_t offset(const Coord& node) noexcept {
    return static_cast<std::size_t>(leaf_offset(node >> 3));
  }

  std::unordered_map<Coord, Chunk> chunks_;
  Chunk* last_ = nullptr;  // the chunk last written to, which stays where it is
  Coord last_key_;
};

}  // namespace argil
