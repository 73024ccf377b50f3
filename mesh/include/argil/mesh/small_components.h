// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Components that were taken out of a mesh, and how many.
struct SmallComponents {
  /// All of them together, as io::measure_error wants what was left out; empty for none.
  TriangleMesh mesh;
  std::int64_t count = 0;
};

/// Takes out the closed components that enclose less than one voxel: specks that no print can show,
/// and that a slicer would count as parts.
///
/// Shapes       mesh: closed components, no two of which share a vertex, as an extracted surface
///              has; no triangle names a vertex twice. A cavity is a component too. Where none is
///              small nothing changes, else normals and vertices without a triangle go as well. A
///              mesh of nothing but specks becomes empty.
/// Units        positions in mm, voxel_mm > 0.
/// Errors       throws std::bad_alloc: to be called within no_throw.
/// Cost         linear.
SmallComponents drop_small_components(TriangleMesh& mesh, double voxel_mm);

/// Puts those components back that have one of `vertices`, behind all else of the mesh. Returns how
/// many.
///
/// Shapes       mesh: what they were taken out of, without normals; vertices: of small.mesh.
/// Errors       throws std::bad_alloc: to be called within no_throw.
/// Cost         linear in what was taken out.
std::int64_t put_back(TriangleMesh& mesh, SmallComponents& small,
                      std::span<const std::uint32_t> vertices);

}  // namespace argil::mesh
