// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/rounding.h"

namespace argil::mesh {

/// Not inline: g++ 12.2 -O3 forgets the rounding where the floats become doubles again
/// (MeshRepair.LeavesTheBytesOfUntouchedTriangles).
[[gnu::noinline]] std::array<float, 3> floats_of(const Vec3& p) noexcept {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

TriangleMesh rounded_to_float(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) {
    const auto [x, y, z] = floats_of(p);
    p = {double{x}, double{y}, double{z}};
  }
  return mesh;
}

}  // namespace argil::mesh
