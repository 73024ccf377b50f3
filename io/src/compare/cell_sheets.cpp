// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/cell_sheets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>

#include "argil/core/vec3.h"

#include "compare/distance_sums.h"
#include "compare/lattice_edge.h"
#include "compare/triangle_runs.h"

namespace argil::io {
namespace {

using CornerSet = unsigned;  ///< bit n: corner n

/// Whether steps along `ways`, which differ in the bits of a corner's number, lead from any of the
/// corners to all of them.
bool hang_together(CornerSet corners, std::initializer_list<unsigned> ways) {
  CornerSet met = corners & (~corners + 1);  // the first
  for (CornerSet before = 0; before != met;) {
    before = met;
    for (unsigned corner = 0; corner < 8; ++corner) {
      if ((met >> corner & 1U) == 0) continue;
      for (const unsigned way : ways) met |= corners & 1U << (corner ^ way);
    }
  }
  return met == corners;
}

/// Whether the extracted surface passes through a cell in one sheet, whatever its values: where its
/// corners inside hang together along edges, and those outside along edges and across faces.
bool has_one_sheet(const SurfaceCell& cell) {
  static const std::array<bool, 256> has_one = [] {
    std::array<bool, 256> made{};
    for (CornerSet inside = 0; inside < made.size(); ++inside) {
      made[inside] =
          hang_together(inside, {1, 2, 4}) && hang_together(~inside & 0xffU, {1, 2, 4, 3, 5, 6});
    }
    return made;
  }();
  CornerSet inside = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    inside |= (cell.corners[corner] < 0.0F ? 1U : 0U) << corner;
  }
  return has_one[inside];
}

/// Finds the sheets of one cell after another.
class SheetSearch {
 public:
  /// `runs` of the surface; null where all cells have all vertices.
  SheetSearch(const TriangleMesh& surface, const TriangleRuns* runs, double voxel_mm)
      : surface_(surface), runs_(runs), voxel_mm_(voxel_mm) {}

  /// A vertex of each sheet that the cell's triangles are of or that passes through an edge of it,
  /// but for that of its first triangle and what shares a vertex with one found before.
  const std::vector<std::uint32_t>& others_in(const SurfaceCell& cell) {
    others_.clear();
    met_.clear();
    meet(cell.first);
    for (std::uint32_t t = cell.first + 1; t < cell.first + cell.count; ++t) add(t);
    if (has_all_vertices(cell, surface_)) return others_;
    assert(runs_ != nullptr);
    const Vec3 low = cell.low_mm(voxel_mm_);
    const double side = cell.side_mm(voxel_mm_);
    for_each_cut_edge(cell, [&](const LatticeEdge&, const Vec3& place) {
      constexpr double kAnywhere = std::numeric_limits<double>::infinity();
      add(runs_->closest(low + side * place, {kAnywhere, kNoTriangle}).triangle);
    });
    return others_;
  }

 private:
  void add(std::uint32_t t) {
    if (!meet(t)) others_.push_back(surface_.triangles[t][0]);
  }
  /// Whether a vertex of the triangle was met before; all of them are then.
  bool meet(std::uint32_t t) {
    const Triangle& corners = surface_.triangles[t];
    const bool is_known = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return std::find(met_.begin(), met_.end(), v) != met_.end();
    });
    met_.insert(met_.end(), corners.begin(), corners.end());
    return is_known;
  }

  const TriangleMesh& surface_;
  const TriangleRuns* runs_;
  double voxel_mm_;
  std::vector<std::uint32_t> met_;
  std::vector<std::uint32_t> others_;
};

}  // namespace

CellSheets::CellSheets(const TriangleMesh& surface, const std::vector<SurfaceCell>& cells,
                       double voxel_mm, const Pace& pace) {
  // Mostly none lacks a vertex: then nothing is searched.
  std::atomic<bool> lacks_any = false;
  std::vector<std::vector<std::uint32_t>> candidates(block_count(cells.size()));
  in_blocks(cells.size(), pace.part(0.0, 0.3), [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      if (has_one_sheet(cells[c])) continue;
      candidates[begin / kDistanceBlock].push_back(static_cast<std::uint32_t>(c));
      if (!has_all_vertices(cells[c], surface)) lacks_any = true;
    }
  });
  std::optional<TriangleRuns> runs;
  if (lacks_any) runs.emplace(surface, pace.part(0.3, 0.5));
  struct Found {
    std::vector<Sheets> sheets;
    std::vector<std::uint32_t> vertices;
  };
  std::vector<Found> blocks(candidates.size());
  in_blocks(cells.size(), pace.part(0.5, 1.0), [&](std::size_t begin, std::size_t) {
    SheetSearch search(surface, runs ? &*runs : nullptr, voxel_mm);
    Found& found = blocks[begin / kDistanceBlock];
    for (const std::uint32_t c : candidates[begin / kDistanceBlock]) {
      const std::vector<std::uint32_t>& others = search.others_in(cells[c]);
      if (others.empty()) continue;
      found.sheets.push_back({c, static_cast<std::uint32_t>(found.vertices.size())});
      found.vertices.insert(found.vertices.end(), others.begin(), others.end());
    }
  });
  for (const Found& found : blocks) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (const Sheets& of : found.sheets) sheets_.push_back({of.cell, first + of.first});
    vertices_.insert(vertices_.end(), found.vertices.begin(), found.vertices.end());
  }
  sheets_.push_back(
      {static_cast<std::uint32_t>(cells.size()), static_cast<std::uint32_t>(vertices_.size())});
}

std::span<const std::uint32_t> CellSheets::others_in(std::uint32_t cell) const {
  const auto at =
      std::lower_bound(sheets_.begin(), sheets_.end(), cell,
                       [](const Sheets& of, std::uint32_t number) { return of.cell < number; });
  // Past all of them is one of no cell.
  if (at == sheets_.end() || at + 1 == sheets_.end() || at->cell != cell) return {};
  return std::span(vertices_).subspan(at->first, (at + 1)->first - at->first);
}

}  // namespace argil::io
