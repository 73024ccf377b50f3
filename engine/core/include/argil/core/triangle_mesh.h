// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "argil/core/vec3.h"

namespace argil {

/// Three indices into the positions of a mesh, counter-clockwise seen from outside. Which of the
/// three comes first means nothing, but is kept, as it shows in the bytes of files.
using Triangle = std::array<std::uint32_t, 3>;

/// Indexed triangles, counter-clockwise seen from outside. What every folder hands to every other.
///
/// Nothing is promised beyond that: the mesh may be open, crossing, empty, or have positions that
/// no triangle names. What a function needs beyond this it says under Shapes.
struct TriangleMesh {
  /// In mm once inside Argil; in the file's units straight from a reader. At most 2^32, since that
  /// is what a Triangle can name.
  std::vector<Vec3> positions;
  /// Of unit length, outward; empty, or one per position. Only the surface of a clay has them (from
  /// grad phi): readers do not fill them, and what moves positions leaves them out.
  std::vector<Vec3> normals;
  /// Indices into `positions`. Readers of files refuse one that names a position which is not
  /// there; behind them functions rely on that and assert it, but for mesh::check_mesh, which
  /// tells.
  std::vector<Triangle> triangles;
};

/// The bounds of all positions, used by a triangle or not; empty for no positions
/// (TriangleMesh.BoundsAllPositionsUsedOrNot). mesh::used_bounds leaves out those of no triangle.
/// Positions must not be NaN, as Box3::include has it. Linear.
inline Box3 bounds(const TriangleMesh& mesh) noexcept {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return box;
}

/// Enclosed volume by the divergence theorem; positive when triangles face outward.
///
/// Shapes       closed, or the number means nothing; every index must exist. 0 without triangles
///              (TriangleMesh.IsNothingWhenEmpty). A cavity counts as negative, a part that lies
///              in another twice.
/// Units        the cube of the positions' unit.
/// Accuracy     summed about the bounds' centre, so that a place far from the origin costs few
///              digits (TriangleMesh.KeepsItsVolumeFarFromTheOrigin).
/// Determinism  same bits every time: one thread, in index order.
/// Threads      any while nobody changes the mesh; noexcept, does not allocate. Linear.
inline double signed_volume(const TriangleMesh& mesh) noexcept {
  const Vec3 o = bounds(mesh).center();
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes +=
        dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o));
  }
  return six_volumes / 6.0;
}

/// Sum of the triangles' areas, in the square of the positions' unit; open meshes have one too. A
/// triangle that is there twice counts twice, and so does what lies within the solid.
///
/// Shapes       every index must exist. 0 without triangles.
/// Determinism  same bits every time: one thread, in index order.
/// Threads      any while nobody changes the mesh; noexcept, does not allocate. Linear.
inline double surface_area(const TriangleMesh& mesh) noexcept {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles) {
    twice += length(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                          mesh.positions[t[2]] - mesh.positions[t[0]]));
  }
  return twice / 2.0;
}

}  // namespace argil
