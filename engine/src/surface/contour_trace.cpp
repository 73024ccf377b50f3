// SPDX-License-Identifier: GPL-3.0-or-later
// All loops are traced by ContourCell, so that what is kept cannot differ from what is traced anew.
#include "surface/contour_trace.h"

#include <bit>
#include <cassert>

#include "surface/contour_loop.h"

namespace argil {
namespace {

/// Cells around one cell, as bits.
class CellsAround : public Refinement {
 public:
  explicit CellsAround(std::uint32_t refined) : refined_(refined) {}
  bool refined([[maybe_unused]] int depth, const Coord& cell) const override {
    assert(depth == 0);
    const int bit = 9 * (cell.x() + 1) + 3 * (cell.y() + 1) + cell.z() + 1;
    return (refined_ >> static_cast<unsigned>(bit) & 1U) != 0;
  }

 private:
  std::uint32_t refined_;
};

/// Those that share a face or an edge with the cell in the middle; no polygon depends on others.
constexpr std::uint32_t kBesideFacesAndEdges = 0b010'111'010'111'101'111'010'111'010;

TracedCut counted_from_cell(const ContourCell& cell, const ContourCut& cut) {
  const Coord low = cell.position(cut.low);
  const int length = (cell.position(cut.high) - low)[cut.axis];
  const int shift = std::countr_zero(static_cast<unsigned>(length));
  const Coord node = low >> shift;
  return {static_cast<std::uint8_t>(cell.depth() - shift),
          cut.axis,
          cut.planes,
          {static_cast<std::uint8_t>(node.x()), static_cast<std::uint8_t>(node.y()),
           static_cast<std::uint8_t>(node.z())},
          static_cast<std::uint16_t>(edge_slot(node.x(), node.y(), node.z(), cut.axis))};
}

void set_insides(ContourCell& cell, std::uint32_t inside) {
  for (const std::uint16_t node : cell.nodes()) cell.set_inside(node, (inside >> node & 1U) != 0);
}

std::array<TracedCell, 256> trace_all_patterns() {
  ContourCell cell;
  cell.build(CellsAround(0), Coord(0), 0);
  std::array<TracedCell, 256> cells;
  for (std::uint32_t pattern = 0; pattern < cells.size(); ++pattern) {
    set_insides(cell, pattern);
    cell.trace();
    cells[pattern] = traced(cell);
  }
  return cells;
}

}  // namespace

// A lone loop cannot cross itself while it has four corners or a centre, nor with five in an
// undivided cell: those project to a convex pentagon.
TracedCell traced(const ContourCell& cell) {
  TracedCell made;
  for (const std::uint16_t index : cell.loop_cuts()) {
    made.cuts.push_back(counted_from_cell(cell, cell.cuts()[index]));
  }
  made.may_cross = cell.loop_lengths().size() > 1;
  std::size_t first = 0;
  std::vector<LoopCorner> corners;
  for (const std::uint16_t length : cell.loop_lengths()) {
    corners.assign(length, {});
    for (std::size_t i = 0; i < length; ++i) corners[i].planes = made.cuts[first + i].planes;
    const bool has_centre = needs_centre(corners);
    made.loops.push_back({length, has_centre});
    made.centres += has_centre ? 1 : 0;
    made.may_cross |= !has_centre && length > 4 && cell.depth() > 0;
    first += length;
  }
  return made;
}

const std::array<TracedCell, 256>& undivided_cells() {
  static const std::array<TracedCell, 256> cells = trace_all_patterns();
  return cells;
}

std::uint32_t DividedCells::nodes_of(std::uint32_t refined) {
  if (refined == last_refined_ && last_nodes_ != 0) return last_nodes_;
  auto known = nodes_.find(refined);
  if (known == nodes_.end()) {
    cell_.build(CellsAround(refined), Coord(0), 1);
    std::uint32_t nodes = 0;
    for (const std::uint16_t node : cell_.nodes()) nodes |= 1U << node;
    known = nodes_.emplace(refined, nodes).first;
  }
  last_refined_ = refined;
  return last_nodes_ = known->second;
}

const TracedCell* DividedCells::find(std::uint32_t refined, std::uint32_t inside) {
  refined &= kBesideFacesAndEdges;
  const std::uint32_t nodes = nodes_of(refined);
  inside &= nodes;
  if (inside == 0 || inside == nodes) return nullptr;
  const std::uint64_t key = std::uint64_t{refined} << 32 | inside;
  auto known = cells_.find(key);
  if (known == cells_.end()) {
    cell_.build(CellsAround(refined), Coord(0), 1);
    set_insides(cell_, inside);
    cell_.trace();
    known = cells_.emplace(key, traced(cell_)).first;
  }
  return &known->second;
}

void DividedCells::forget_many() {
  constexpr std::size_t kMany = 4096;
  if (cells_.size() + nodes_.size() < kMany) return;
  cells_.clear();
  nodes_.clear();
  last_nodes_ = 0;
}

}  // namespace argil
