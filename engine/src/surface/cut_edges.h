// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "field/level_stack.h"
#include "rows/rows.h"
#include "surface/contour_trace.h"

namespace argil {

/// How far a vertex keeps from the ends of its lattice edge, as a fraction of the edge: what it is
/// off the surface by at most, where it must stay on the edge; and where it need not, but goes back
/// onto the surface from there. Measured in docs/surface.md: the larger, the fewer slivers.
inline constexpr double kCutMargin = 0.02;
inline constexpr double kMovedCutMargin = 0.12;

/// Whether nodes are inside: bit z of row (x, y), 0 to 8 each.
using InsideRows = std::array<std::array<std::uint16_t, 9>, 9>;
/// Cells of a leaf: bit z of row 8 x + y.
using CellRows = std::array<std::uint8_t, 64>;

/// The edges of a leaf's own lattice that the surface cuts, and the numbers of their vertices.
class CutEdges {
 public:
  static constexpr std::uint32_t kNoVertex = 0xffffffff;

  /// Forgets all and numbers the cut edges of these cells, row by row. `is_shared`: all of them are
  /// of interest to other blocks, not only those on the leaf's faces.
  void number(const InsideRows& inside, const CellRows& cells, bool is_shared);

  /// The vertex of an edge, numbered now when it was not: that needs forget_vertices() before
  /// number(). It is shared.
  std::uint32_t find_or_add(const Coord& low, int axis);

  /// After this the vertex of an edge that is not numbered is kNoVertex, else anything.
  void forget_vertices() noexcept { vertex_of_.fill(kNoVertex); }
  /// By edge_slot().
  std::uint32_t vertex(std::size_t slot) const noexcept {
    assert(slot < kEdgeSlots);
    return vertex_of_[slot];
  }

  /// Marks the ends of all edges beside which vertices stay on them.
  template <class Stays>
  void mark_staying(const Stays& stays) {
    for (int n = 0; n < count_; ++n) {
      unsigned& code = codes_[static_cast<std::size_t>(n)];
      Coord node = low_of(code);
      if (stays(node)) code |= CutJob::kLowStays;
      ++node[axis_of(code)];
      if (stays(node)) code |= CutJob::kHighStays;
    }
  }

  int count() const noexcept { return count_; }
  /// Of all edges, by vertex: CutJob says what. May be read up to a multiple of CutJob::kLanes.
  const unsigned* codes() const noexcept { return codes_.data(); }
  static Coord low_of(unsigned code) noexcept {
    const auto byte = [&](unsigned shift) { return static_cast<int>(code >> shift & 0xffU); };
    return {byte(16), byte(8), byte(0)};
  }
  static int axis_of(unsigned code) noexcept { return static_cast<int>(code >> 24 & 3U); }

 private:
  void add_row(unsigned edges, int x, int y, unsigned axis, unsigned shared);

  static constexpr std::size_t kMost = 3 * 9 * 9 * 8;
  static_assert(kMost % CutJob::kLanes == 0);
  int count_ = 0;
  std::array<unsigned, kMost> codes_{};
  std::array<std::uint32_t, kEdgeSlots> vertex_of_{};
};

}  // namespace argil
