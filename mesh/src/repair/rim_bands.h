// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

/// A rim: boundary half-edges in order, each vertex once.
using RimLoop = std::vector<HalfEdge>;

/// Loops of different parts that run beside each other all round, and the same way: halves of a
/// solid that crack apart or reach over each other, the two sides of a wall without its rim. A lid
/// on each would be inside of what they enclose together. Nearest pairs first, a loop once. Not
/// where loops are so many and long that comparing them would take a second.
std::vector<std::pair<std::size_t, std::size_t>> loops_beside(const TriangleMesh& mesh,
                                                              const EdgeTable& edges,
                                                              const MeshParts& parts,
                                                              const std::vector<RimLoop>& loops);

/// Triangles from one such loop to the other, on their vertices alone, which close both.
std::vector<Triangle> band_between(const TriangleMesh& mesh, const EdgeTable& edges,
                                   const RimLoop& a, const RimLoop& b);

}  // namespace argil::mesh
