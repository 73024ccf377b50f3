// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil::io {

/// A cell that phi = 0 passes through, and triangles of an extracted surface that stand for that.
struct SurfaceCell {
  std::array<float, 8> corners{};     ///< as FieldCell has them
  std::array<std::int32_t, 3> low{};  ///< its low corner, in cells of its level
  std::uint32_t first = 0;            ///< the first of its triangles ...
  std::uint16_t count = 0;            ///< ... and how many follow one another, some beside it
  std::int8_t level = 0;
  bool is_empty = false;  ///< none lies in it: its triangle is the nearest one beside it

  double side_mm(double voxel_mm) const noexcept { return std::ldexp(voxel_mm, level); }
  Vec3 low_mm(double voxel_mm) const noexcept {
    return side_mm(voxel_mm) * Vec3{1.0 * low[0], 1.0 * low[1], 1.0 * low[2]};
  }
};

/// The cells that phi = 0 passes through and that `surface`, as extracted from the clay, stands
/// for, each once, in the order of their triangles: of each triangle the cell that it lies in and
/// those beside it that may have been its own. No crossed cell is without a triangle so near.
///
/// Shapes       surface: as extract_surface gives it, components left out or not; coordinates of
///              2^18 cells of their level at most.
/// Errors       throws Interrupted.
/// Determinism  same cells for any number of threads.
/// Threads      as Clay; spreads over TBB.
/// Cost         0.6 us a triangle; some 110 bytes a cell while it runs, 52 of them its result.
std::vector<SurfaceCell> surface_cells(const TriangleMesh& surface, const Clay& clay,
                                       const Pace& pace);

/// Whether a cell's triangles have a vertex for each of its edges that phi = 0 passes through.
bool has_all_vertices(const SurfaceCell& cell, const TriangleMesh& surface);

}  // namespace argil::io
