// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "argil/core/vec3.h"

#include "compare/cell_set.h"

namespace argil::io {

/// An edge of the lattice of a level: its low node in cells of that level, and which way it runs.
struct LatticeEdge {
  std::int8_t level = 0;
  std::int8_t axis = 0;
  std::array<std::int32_t, 3> low{};

  auto operator<=>(const LatticeEdge&) const = default;
};

/// The edge of a level that a vertex lies on, where it lies on one: between its ends, since no
/// vertex is nearer to them than a fiftieth of its edge (docs/surface.md).
inline std::optional<LatticeEdge> edge_at(const Vec3& vertex_mm, std::int8_t level,
                                          double voxel_mm) {
  // Rounding of doubles leaves a thousandth of this, 2^18 voxels away.
  constexpr double kOnLattice = 1e-6;
  assert(is_finite(vertex_mm));
  const Vec3 in_cells = vertex_mm / std::ldexp(voxel_mm, level);
  LatticeEdge edge;
  edge.level = level;
  int across = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double nearest = std::round(in_cells[axis]);
    const bool is_on_lattice = std::abs(in_cells[axis] - nearest) <= kOnLattice;
    across += is_on_lattice ? 1 : 0;
    if (!is_on_lattice) edge.axis = static_cast<std::int8_t>(axis);
    edge.low[axis] =
        static_cast<std::int32_t>(is_on_lattice ? nearest : std::floor(in_cells[axis]));
  }
  if (across != 2) return std::nullopt;
  return edge;
}

/// Calls `use(edge, p)` for each edge of a cell that phi = 0 passes through, with the place within
/// the cell where it does.
template <class Use>
void for_each_cut_edge(const SurfaceCell& cell, const Use& use) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t step = std::size_t{4} >> axis;
      if ((corner & step) != 0) continue;
      const double a = cell.corners[corner];
      const double b = cell.corners[corner | step];
      if ((a < 0.0) == (b < 0.0)) continue;
      LatticeEdge edge{cell.level, static_cast<std::int8_t>(axis), cell.low};
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool is_high = (corner & std::size_t{4} >> k) != 0;
        edge.low[k] += is_high ? 1 : 0;
        p[k] = is_high ? 1.0 : 0.0;
      }
      p[axis] = a / (a - b);
      use(edge, p);
    }
  }
}

}  // namespace argil::io
