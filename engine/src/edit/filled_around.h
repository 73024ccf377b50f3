// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "edit/level_edit.h"

namespace argil {

/// The leaves beside some leaves of an edit that neither the edit nor the stack has, filled from
/// the coarser levels as they were before the edit: each once, and without solving anything where
/// all of it is farther from the surface than the band.
class FilledAround {
 public:
  enum class Reach {
    beside,  ///< the six that have a face in common
    around,  ///< all 26
  };
  /// Those of each of `origins`. In parallel.
  FilledAround(const LevelEdit& edit, std::span<const Coord> origins, Reach reach);
  FilledAround(const FilledAround&) = delete;
  FilledAround& operator=(const FilledAround&) = delete;

  /// For one thread.
  class Reader {
   public:
    explicit Reader(const FilledAround& filled) : filled_(filled), index_(filled.index_) {}
    /// Null for others than those.
    const float* values(const Coord& origin) {
      const std::uint32_t found = index_.get(origin);
      return found == 0 ? nullptr : filled_.values_[found - 1];
    }

   private:
    const FilledAround& filled_;
    LeafMap<std::uint32_t>::Reader index_;
  };

 private:
  LeafMap<std::uint32_t> index_;  ///< one more than that in values_
  std::vector<const float*> values_;
  std::vector<LeafValues> own_;
  LeafValues inside_;
  LeafValues outside_;
};

}  // namespace argil
