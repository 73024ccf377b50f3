// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Some vertices of a mesh in the cells of a lattice, to find those in a box.
/// Threads  reading from any.
class PointGrid {
 public:
  /// The mesh must stay. Cells are made larger where there would be more than 2^21 along an axis.
  PointGrid(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices, double side_mm);

  /// Calls `act` for each vertex in the box, and for some beside it; in no order.
  template <class Act>
  void for_box(const Vec3& low, const Vec3& high, const Act& act) const {
    const Cell first = cell_of(low);
    const Cell last = cell_of(high);
    const std::uint64_t rows = (last.x - first.x + 1) * (last.y - first.y + 1);
    if (rows > entries_.size()) {
      for (const Entry& entry : entries_) act(entry.vertex);
      return;
    }
    for (std::uint64_t x = first.x; x <= last.x; ++x) {
      for (std::uint64_t y = first.y; y <= last.y; ++y) {
        const std::uint64_t end = key_of({x, y, last.z});
        for (auto at = lower_bound(key_of({x, y, first.z})); at != entries_.end(); ++at) {
          if (at->key > end) break;
          act(at->vertex);
        }
      }
    }
  }

 private:
  struct Cell {
    std::uint64_t x, y, z;
  };
  struct Entry {
    std::uint64_t key;
    std::uint32_t vertex;
  };
  static std::uint64_t key_of(const Cell& cell) noexcept;
  Cell cell_of(const Vec3& p) const noexcept;
  std::vector<Entry>::const_iterator lower_bound(std::uint64_t key) const noexcept;

  Vec3 low_;
  double side_mm_;
  std::vector<Entry> entries_;  ///< by their keys: x, then y, then z of their cells
};

}  // namespace argil::mesh
