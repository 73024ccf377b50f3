// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raycast/field_ray.h"

namespace argil {

/// Octants of leaves with the nodes next to them, so that whoever asks for points in the same
/// hundred thousand voxels looks each node up once. Valid while nobody writes the stack, which must
/// be nested.
///
/// Cost  0.5 kB an octant, 8 MB for as many as are usual: then it begins anew. 0.1 us where an
/// octant is asked for
///       the first time, 0.5 us the second, 5 ns from then on.
class OctantStore {
 public:
  static constexpr std::uint32_t kUsualMost = 16384;
  /// Remembers `most` octants at most, 1 or more.
  explicit OctantStore(const LevelStack& stack, std::uint32_t most = kUsualMost)
      : most_(most), cells_(stack), slots_(kFirstSlots) {
    assert(most >= 1);
  }

  int finest_level(const Coord& cell) { return cells_.finest_level(cell); }

  /// The corners of a cell, as FieldCell has them, of the level that is the finest there.
  std::array<float, 8> corners(int level, const Coord& cell) {
    const Coord low = cell & ~3;
    const float* const octant = known(level, low);
    if (octant == nullptr) {
      cells_.open(level, cell << level);
      return cells_.corners(cell);
    }
    const Coord in = cell - low;
    const float* const at = octant + (in.x() * 25 + in.y() * 5 + in.z());
    return {at[0], at[1], at[5], at[6], at[25], at[26], at[30], at[31]};
  }

 private:
  using Values = std::array<float, 125>;
  static constexpr std::size_t kFirstSlots = 256;
  static constexpr std::uint32_t kChunk = 64;
  struct Slot {
    Coord low;
    int level = -1;  ///< of nothing
    std::uint32_t number = 0;
  };

  /// The values of the octant from `low` on; null when it is asked for the first time for long,
  /// since many are never asked again.
  const float* known(int level, const Coord& low) {
    assert(level >= 0);
    const std::size_t hash = hash_of(level, low);
    const std::size_t at = slot_for(hash, level, low);
    if (slots_[at].level == level) return values_of(slots_[at].number).data();
    Slot& once = once_[hash % once_.size()];
    if (once.level != level || once.low != low) {
      once = {low, level, 0};
      return nullptr;
    }
    if (count_ == most_) forget();
    if (2 * count_ >= slots_.size()) grow();
    const std::uint32_t number = count_++;
    if (number / kChunk == chunks_.size()) {
      chunks_.push_back(std::make_unique_for_overwrite<Values[]>(kChunk));
    }
    slots_[slot_for(hash, level, low)] = {low, level, number};
    cells_.open(level, low << level);
    cells_.octant(low, values_of(number));
    return values_of(number).data();
  }

  Values& values_of(std::uint32_t number) { return chunks_[number / kChunk][number % kChunk]; }

  static std::size_t hash_of(int level, const Coord& low) noexcept {
    const auto place = [](int along) { return static_cast<unsigned>(along >> 2); };
    return place(low.x()) * 73856093U ^ place(low.y()) * 19349663U ^ place(low.z()) * 83492791U ^
           static_cast<unsigned>(level) * 40503U;
  }
  /// Where an octant is, or would be.
  std::size_t slot_for(std::size_t hash, int level, const Coord& low) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (slots_[at].level >= 0 && (slots_[at].level != level || slots_[at].low != low)) {
      at = (at + 1) & mask;
    }
    return at;
  }
  void grow() {
    std::vector<Slot> before(2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before) {
      if (slot.level >= 0)
        slots_[slot_for(hash_of(slot.level, slot.low), slot.level, slot.low)] = slot;
    }
  }
  void forget() {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    count_ = 0;
  }

  std::uint32_t most_;
  LeafCells cells_;
  std::array<Slot, 64> once_;  ///< asked for once, lately
  std::vector<Slot> slots_;    ///< as many as a power of two
  std::uint32_t count_ = 0;
  std::vector<std::unique_ptr<Values[]>> chunks_;
};

}  // namespace argil
