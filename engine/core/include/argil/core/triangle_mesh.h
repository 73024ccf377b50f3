// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil {

/// Three indices into the positions of a mesh, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Indexed triangles, counter-clockwise seen from outside. What every folder hands to every other.
///
/// Nothing is promised beyond that: the mesh may be open, crossing, empty, or have positions that
/// no triangle names. What a function needs beyond this it says under Shapes.
struct TriangleMesh {
  /// In mm once inside Argil; in the file's units straight from a reader. Indices to them have 32
  /// bits.
  std::vector<Vec3> positions;
  /// Of unit length, outward; empty, or one per position.
  std::vector<Vec3> normals;
  /// Indices into `positions`.
  std::vector<Triangle> triangles;
};

/// The bounds of all positions, used by a triangle or not; empty for no positions
/// (TriangleMesh.BoundsAllPositionsUsedOrNot).
inline Box3 bounds(const TriangleMesh& mesh) noexcept {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return box;
}

/// Enclosed volume by the divergence theorem; positive when triangles face outward.
///
/// Shapes       closed, or the number means nothing; every index must exist.
/// Units        the cube of the positions' unit.
/// Accuracy     summed about the bounds' centre, so that a place far from the origin costs few
///              digits (TriangleMesh.KeepsItsVolumeFarFromTheOrigin).
/// Determinism  same bits every time: one thread, in index order.
inline double signed_volume(const TriangleMesh& mesh) noexcept {
  const Vec3 o = bounds(mesh).center();
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes +=
        dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o));
  }
  return six_volumes / 6.0;
}

/// Sum of the triangles' areas, in the square of the positions' unit. Summed in index order.
inline double surface_area(const TriangleMesh& mesh) noexcept {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles) {
    twice += length(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                          mesh.positions[t[2]] - mesh.positions[t[0]]));
  }
  return twice / 2.0;
}

}  // namespace argil
