// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edit/edit.h"
#include "field/leaf_map.h"

namespace argil {

/// Leaves of all levels, stored or not, each once: for lists that name the same ones many times.
class LeafSet {
 public:
  explicit LeafSet(int levels) : levels_(static_cast<std::size_t>(levels)) {}

  /// Whether it was not there before.
  bool insert(int level, const Coord& origin) {
    assert(level >= 0 && static_cast<std::size_t>(level) < levels_.size());
    std::uint8_t& is_there = levels_[static_cast<std::size_t>(level)].at(origin);
    if (is_there != 0) return false;
    is_there = 1;
    return true;
  }

  /// Those of a level, sorted.
  std::vector<Coord> sorted(int level) const {
    std::vector<Coord> origins;
    levels_[static_cast<std::size_t>(level)].for_each(
        [&](const Coord& origin, std::uint8_t) { origins.push_back(origin); });
    std::sort(origins.begin(), origins.end());
    return origins;
  }
  /// All, the finest level first, sorted.
  LeafList list() const {
    LeafList all;
    for (std::size_t n = 0; n < levels_.size(); ++n) {
      const int level = static_cast<int>(n);
      for (const Coord& origin : sorted(level)) all.emplace_back(level, origin);
    }
    return all;
  }

 private:
  std::vector<LeafMap<std::uint8_t>> levels_;
};

}  // namespace argil
