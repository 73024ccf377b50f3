// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil {

using Triangle = std::array<std::uint32_t, 3>;

/// Indexed triangles, counter-clockwise seen from outside. What every folder hands to every other.
struct TriangleMesh {
  std::vector<Vec3> positions;      ///< mm once inside Argil; file units straight from a reader
  std::vector<Vec3> normals;        ///< unit, outward; empty, or one per position
  std::vector<Triangle> triangles;  ///< indices into positions
};

/// The bounds of all positions, used by a triangle or not; empty for no positions.
inline Box3 bounds(const TriangleMesh& mesh) noexcept {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return box;
}

/// Enclosed volume in units^3 by the divergence theorem; positive when triangles face outward.
/// Meaningful only for closed meshes. Summed about the bounds' centre, in index order.
inline double signed_volume(const TriangleMesh& mesh) noexcept {
  const Vec3 o = bounds(mesh).center();
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes +=
        dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o));
  }
  return six_volumes / 6.0;
}

/// Sum of triangle areas in units^2, in index order.
inline double surface_area(const TriangleMesh& mesh) noexcept {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles) {
    twice += length(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                          mesh.positions[t[2]] - mesh.positions[t[0]]));
  }
  return twice / 2.0;
}

}  // namespace argil
