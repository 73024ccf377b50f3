// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/cut_edges.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace argil {
namespace {

/// Bits of the nodes along z that the ends of these cells are.
constexpr unsigned ends_of(unsigned cells) noexcept { return cells | cells << 1; }

unsigned cells_at(const CellRows& cells, int x, int y) noexcept {
  const bool is_there = x >= 0 && x < kLeafSide && y >= 0 && y < kLeafSide;
  return is_there ? cells[static_cast<std::size_t>(kLeafSide * x + y)] : 0U;
}

constexpr bool is_on_face(int coordinate) noexcept { return (coordinate & 7) == 0; }

}  // namespace

/// An edge along an axis belongs to up to four cells, on either side of it along the other two.
void CutEdges::number(const InsideRows& inside, const CellRows& cells, bool is_shared) {
  count_ = 0;
  constexpr unsigned kFaces = 0x101;
  for (int x = 0; x <= kLeafSide; ++x) {
    for (int y = 0; y <= kLeafSide; ++y) {
      const unsigned before_both = cells_at(cells, x - 1, y - 1);
      const unsigned before_x = cells_at(cells, x - 1, y);
      const unsigned before_y = cells_at(cells, x, y - 1);
      const unsigned here = cells_at(cells, x, y);
      if ((before_both | before_x | before_y | here) == 0) continue;
      const auto i = static_cast<std::size_t>(x);
      const auto j = static_cast<std::size_t>(y);
      const unsigned row = inside[i][j];
      const auto shared = [&](bool is_on) { return is_shared || is_on ? ~0U : kFaces; };
      if (const unsigned asked = ends_of(before_y | here); asked != 0 && x < kLeafSide) {
        add_row((row ^ inside[i + 1][j]) & asked, x, y, 0, shared(is_on_face(y)));
      }
      if (const unsigned asked = ends_of(before_x | here); asked != 0 && y < kLeafSide) {
        add_row((row ^ inside[i][j + 1]) & asked, x, y, 1, shared(is_on_face(x)));
      }
      const bool is_on = is_shared || is_on_face(x) || is_on_face(y);
      add_row((row ^ row >> 1) & (before_both | before_x | before_y | here), x, y, 2,
              is_on ? ~0U : 0U);
    }
  }
  const auto first = static_cast<std::size_t>(count_);
  for (std::size_t n = first; n % CutJob::kLanes != 0; ++n) codes_[n] = codes_[first - 1];
}

/// Of row (x, y), low nodes `edges`, of which `shared` have a key.
void CutEdges::add_row(unsigned edges, int x, int y, unsigned axis, unsigned shared) {
  const std::size_t slot = edge_slot(x, y, 0, static_cast<int>(axis));
  const unsigned code = axis << 24 | static_cast<unsigned>(x) << 16 | static_cast<unsigned>(y) << 8;
  for (; edges != 0; edges &= edges - 1) {
    const auto z = static_cast<unsigned>(std::countr_zero(edges));
    const auto vertex = static_cast<std::size_t>(count_++);
    assert(vertex < kMost);
    codes_[vertex] = code | z | ((shared >> z & 1U) != 0 ? CutJob::kIsShared : 0U);
    vertex_of_[slot + z] = static_cast<std::uint32_t>(vertex);
  }
}

std::uint32_t CutEdges::find_or_add(const Coord& low, int axis) {
  std::uint32_t& known = vertex_of_[edge_slot(low.x(), low.y(), low.z(), axis)];
  if (known != kNoVertex) return known;
  known = static_cast<std::uint32_t>(count_++);
  assert(known < kMost);
  const unsigned code = static_cast<unsigned>(axis) << 24 | static_cast<unsigned>(low.x()) << 16 |
                        static_cast<unsigned>(low.y()) << 8 | static_cast<unsigned>(low.z());
  std::fill_n(codes_.begin() + known, std::min<std::size_t>(CutJob::kLanes, codes_.size() - known),
              code | CutJob::kIsShared);
  return known;
}

}  // namespace argil
