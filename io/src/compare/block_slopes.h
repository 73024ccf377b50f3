// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include <tbb/concurrent_unordered_map.h>

#include "argil/core/vec3.h"
#include "argil/engine/field_sampler.h"

namespace argil::io {

/// The slopes of phi within cells, along each axis from least to greatest, in mm per mm.
struct Slopes {
  static constexpr int kMixed = -1;

  Box3 range;
  int level = kMixed;  ///< of all the cells

  void include(const FieldCell& cell) {
    // Corner 4 i + 2 j + k: the step to the next along an axis.
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Vec3 slope;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = std::size_t{4} >> axis;
        slope[axis] = cell.per_mm * (static_cast<double>(cell.corners[corner | next]) -
                                     static_cast<double>(cell.corners[corner & ~next]));
      }
      range.include(slope);
    }
  }
  void include(const Slopes& other) {
    level = other.level == level ? level : kMixed;
    range.include(other.range.min);
    range.include(other.range.max);
  }
};

/// A cell of level 0, or a block of these.
using CellIndex = std::array<int, 3>;

template <class Use>
void for_each_index(const CellIndex& first, const CellIndex& last, const Use& use) {
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) use(CellIndex{i, j, k});
    }
  }
}

inline Vec3 middle_of_cell(const CellIndex& cell, double voxel_mm) {
  return voxel_mm * Vec3{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
}

/// The slopes in blocks of 4^3 cells of level 0, looked up once for each.
///
/// Threads      any, each with a field of its own.
class BlockSlopes {
 public:
  explicit BlockSlopes(double voxel_mm) : voxel_mm_(voxel_mm) { assert(voxel_mm > 0.0); }

  static CellIndex block_of(const CellIndex& cell) noexcept {
    return {cell[0] >> kBits, cell[1] >> kBits, cell[2] >> kBits};
  }
  const Slopes& of(const CellIndex& block, FieldSampler& field) {
    const auto known = known_.find(block);
    return known != known_.end() ? known->second
                                 : known_.emplace(block, look_up(block, field)).first->second;
  }

 private:
  static constexpr int kBits = 2;
  struct Hash {
    std::size_t operator()(const CellIndex& i) const noexcept {
      return static_cast<std::size_t>(static_cast<unsigned>(i[0]) * 73856093U ^
                                      static_cast<unsigned>(i[1]) * 19349663U ^
                                      static_cast<unsigned>(i[2]) * 83492791U);
    }
  };

  Slopes look_up(const CellIndex& block, FieldSampler& field) const {
    constexpr int kLast = (1 << kBits) - 1;
    const CellIndex first{block[0] << kBits, block[1] << kBits, block[2] << kBits};
    const CellIndex last{first[0] + kLast, first[1] + kLast, first[2] + kLast};
    Slopes slopes;
    slopes.level = field.cell_at(middle_of_cell(first, voxel_mm_)).level;
    for_each_index(first, last, [&](const CellIndex& index) {
      const FieldCell cell = field.cell_at(middle_of_cell(index, voxel_mm_));
      if (cell.per_mm == 0.0 || cell.level != slopes.level) slopes.level = Slopes::kMixed;
      slopes.include(cell);
    });
    return slopes;
  }

  double voxel_mm_;
  tbb::concurrent_unordered_map<CellIndex, Slopes, Hash> known_;
};

}  // namespace argil::io
