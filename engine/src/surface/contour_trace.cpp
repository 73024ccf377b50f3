// SPDX-License-Identifier: GPL-3.0-or-later
// All loops are traced by ContourCell, so that what is kept cannot differ from what is traced anew.
#include "surface/contour_trace.h"

#include <bit>
#include <cassert>
#include <utility>

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
           static_cast<std::uint8_t>(node.z())}};
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
  std::vector<std::uint32_t> planes;
  for (const std::uint16_t length : cell.loop_lengths()) {
    planes.clear();
    for (std::size_t i = 0; i < length; ++i) planes.push_back(made.cuts[first + i].planes);
    const LoopShape& shape = made.loops.emplace_back(shape_of(planes));
    made.may_cross |= !shape.has_centre() && length > 4 && cell.depth() > 0;
    first += length;
  }
  return made;
}

const std::array<TracedCell, 256>& undivided_cells() {
  static const std::array<TracedCell, 256> cells = trace_all_patterns();
  return cells;
}

DividedCells::Polygons& DividedCells::polygons_of(std::uint32_t refined) {
  if (last_ != nullptr && refined == last_refined_) return *last_;
  auto known = polygons_.find(refined);
  if (known == polygons_.end()) {
    Polygons made;
    made.cell.build(CellsAround(refined), Coord(0), 1);
    for (const std::uint16_t node : made.cell.nodes()) made.nodes |= 1U << node;
    known = polygons_.emplace(refined, std::move(made)).first;
  }
  last_refined_ = refined;
  last_ = &known->second;
  return known->second;
}

const TracedCell* DividedCells::find(std::uint32_t refined, std::uint32_t inside) {
  refined &= kBesideFacesAndEdges;
  Polygons& polygons = polygons_of(refined);
  inside &= polygons.nodes;
  if (inside == 0 || inside == polygons.nodes) return nullptr;
  const std::uint64_t key = std::uint64_t{refined} << 32 | inside;
  auto known = cells_.find(key);
  if (known == cells_.end()) {
    set_insides(polygons.cell, inside);
    polygons.cell.trace();
    known = cells_.emplace(key, traced(polygons.cell)).first;
  }
  return &known->second;
}

void DividedCells::forget_many() {
  constexpr std::size_t kMany = 4096;
  constexpr std::size_t kManyPolygons = 512;  // each takes as much as several cells
  if (cells_.size() >= kMany) cells_.clear();
  if (polygons_.size() < kManyPolygons) return;
  polygons_.clear();
  last_ = nullptr;
}

}  // namespace argil
