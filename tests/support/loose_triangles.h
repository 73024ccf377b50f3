// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// Every triangle with vertices of its own, as an STL has them.
inline TriangleMesh loose_triangles(const TriangleMesh& mesh) {
  TriangleMesh loose;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t v : t) loose.positions.push_back(mesh.positions[v]);
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  return loose;
}

}  // namespace argil::test
