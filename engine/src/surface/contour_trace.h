// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "surface/contour_cell.h"
#include "surface/contour_loop.h"

namespace argil {

/// Where the surface crosses a lattice edge of a cell, counted from the cell.
struct TracedCut {
  std::uint8_t finer = 0;             ///< how many levels the edge's is finer than the cell's
  std::uint8_t axis = 0;              ///< of the edge
  std::uint8_t planes = 0;            ///< as ContourCut::planes
  std::array<std::uint8_t, 3> low{};  ///< its low node, in nodes of that level from the low corner
};

/// Edges of a leaf's own level by axis and low node, whose coordinates are 0 to 8. That of an edge
/// of a cell is the slot of the cell's low corner and axis 0, and the one counted from the cell.
inline constexpr std::size_t kEdgeSlots = 3 * 9 * 9 * 9;
constexpr std::size_t edge_slot(int x, int y, int z, int axis) noexcept {
  return static_cast<std::size_t>(((axis * 9 + x) * 9 + y) * 9 + z);
}

/// The loops in which the surface cuts one cell.
struct TracedCell {
  std::vector<TracedCut> cuts;  ///< of all loops, one loop after the other
  std::vector<LoopShape> loops;
  bool may_cross = false;  ///< their triangles may touch one another
};

/// What ContourCell last traced, to be kept.
TracedCell traced(const ContourCell& cell);

/// The loops of cells none of whose faces and edges is divided, by pattern of inside corners: bit c
/// is that of corner (c >> 2, c >> 1 & 1, c & 1). Traced by ContourCell, so that these and other
/// cells agree. The patterns 0 and 255 have none.
const std::array<TracedCell, 256>& undivided_cells();

/// The loops of cells whose faces and edges are divided once, each traced when it is first asked
/// for: a surface has few different ones. For one thread.
class DividedCells {
 public:
  /// `refined`: bit 9 i + 3 j + k of the cell of the same size at offset (i - 1, j - 1, k - 1) that
  /// is refined. `inside`: bit 9 i + 3 j + k of the node at lattice coordinate (i, j, k). Null
  /// where the surface does not pass. Stays as it is until forget_many().
  const TracedCell* find(std::uint32_t refined, std::uint32_t inside);

  /// Forgets all when there are many, so that memory stays bounded.
  void forget_many();

 private:
  /// The polygons around a cell, and which of its nodes are theirs.
  struct Polygons {
    ContourCell cell;
    std::uint32_t nodes = 0;
  };
  Polygons& polygons_of(std::uint32_t refined);

  std::uint32_t last_refined_ = 0;
  Polygons* last_ = nullptr;
  std::unordered_map<std::uint32_t, Polygons> polygons_;  // by what is refined
  std::unordered_map<std::uint64_t, TracedCell> cells_;   // by that and what is inside
};

}  // namespace argil
