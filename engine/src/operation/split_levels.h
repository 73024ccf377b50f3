// SPDX-License-Identifier: GPL-3.0-or-later
// A clay that is several solids apart, taken to pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

#include "field/level_stack.h"

namespace argil {

/// The solids that a closed surface bounds: outer shells, each with the cavities in it.
struct SurfaceSolids {
  /// Which solid a triangle bounds: numbered by volume, the largest first, and by their first
  /// triangle where that is the same.
  std::vector<std::uint32_t> of_triangle;
  std::vector<double> volume_mm3;  ///< of each
};

/// Shapes       closed, two-manifold, normals outward, no self-intersection, as extract_surface
///              makes it.
/// Determinism  same numbers every time. Throws bad_alloc.
/// Cost         some 50 ns a triangle, and for each cavity one pass over the triangles of the
/// shells
///              whose boxes reach around it.
SurfaceSolids solids_of(const TriangleMesh& surface);

/// Levels for each of `count` parts of a surface, which together are the levels `from`. Part
/// `part_of[t]` gets what triangle t bounds. Leaves that a single part reaches keep their bits; in
/// others each node that lies nearest to another part gets the distance to the part's own
/// triangles.
///
/// Shapes       surface: that of `from`; part_of: one below `count` for each triangle.
/// Errors       interrupted; bad_input where a part is too thin to hold a node. Throws bad_alloc.
/// Determinism  same bits for any number of threads.
/// Cost         as SplitPiece.
Result<std::vector<std::unique_ptr<LevelStack>>> split_levels(
    const LevelStack& from, const TriangleMesh& surface, const std::vector<std::uint32_t>& part_of,
    std::size_t count, double tolerance_mm, const Progress& progress);

}  // namespace argil
