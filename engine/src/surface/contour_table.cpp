// SPDX-License-Identifier: GPL-3.0-or-later
// The table is traced by ContourCell itself, so that the fast path cannot differ from the general.
#include "surface/contour_table.h"

#include <cassert>

#include "surface/contour_cell.h"

namespace argil {

namespace {

class Undivided : public Refinement {
 public:
  bool refined(int, const Coord&) const override { return false; }
};

std::uint8_t edge_number(const ContourCut& cut) {
  constexpr std::array<std::array<int, 2>, 3> kOthers{
      {{2, 1}, {4, 1}, {4, 2}}};  // bits of a corner
  assert(cut.axis < 3 && cut.high < 8);
  const auto& bits = kOthers[cut.axis];
  return static_cast<std::uint8_t>(cut.axis * 4 + ((cut.low & bits[0]) ? 2 : 0) +
                                   ((cut.low & bits[1]) ? 1 : 0));
}

// One pattern of inside corners, traced as a general cell would be.
ContourCase trace_case(ContourCell& cell, int pattern) {
  for (int corner = 0; corner < 8; ++corner) cell.set_inside(corner, (pattern >> corner & 1) != 0);
  cell.trace();
  assert(cell.depth() == 0 && cell.loop_lengths().size() <= 4 && cell.loop_cuts().size() <= 12);
  ContourCase made;
  for (const std::uint16_t length : cell.loop_lengths()) {
    made.lengths[made.loops++] = static_cast<std::uint8_t>(length);
  }
  std::size_t at = 0;
  for (const std::uint16_t cut : cell.loop_cuts()) {
    made.cuts[at++] = edge_number(cell.cuts()[cut]);
  }
  return made;
}

std::array<ContourCase, 256> make_cases() {
  ContourCell cell;
  cell.build(Undivided(), Coord(0), 0);
  std::array<ContourCase, 256> cases;
  for (int pattern = 0; pattern < 256; ++pattern) {
    cases[static_cast<std::size_t>(pattern)] = trace_case(cell, pattern);
  }
  return cases;
}

std::array<ContourEdge, 12> make_edges() {
  std::array<ContourEdge, 12> edges;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = axis == 0 ? 1 : 0;
    const std::size_t c = axis == 2 ? 1 : 2;
    for (std::uint8_t k = 0; k < 4; ++k) {
      ContourEdge& edge = edges[axis * 4 + k];
      edge.axis = static_cast<std::uint8_t>(axis);
      edge.low[b] = k >> 1;
      edge.low[c] = k & 1;
      edge.planes = static_cast<std::uint8_t>((edge.low[b] ? 2U : 1U) << (2 * b) |
                                              (edge.low[c] ? 2U : 1U) << (2 * c));
    }
  }
  return edges;
}

}  // namespace

const std::array<ContourCase, 256>& contour_cases() {
  static const std::array<ContourCase, 256> cases = make_cases();
  return cases;
}

const std::array<ContourEdge, 12>& contour_edges() {
  static const std::array<ContourEdge, 12> edges = make_edges();
  return edges;
}

}  // namespace argil
