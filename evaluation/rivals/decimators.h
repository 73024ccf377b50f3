// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

// What other libraries make of a closed surface: edges collapsed to `triangles` or one fewer, more
// where they find no further edge to collapse. They know the mesh alone, not the clay. Vertices in
// double precision, no normals; nothing when the surface is not a two-manifold to them. One thread.

/// OpenMesh's Decimater with ModQuadric alone: a vertex goes where its neighbour is.
std::optional<TriangleMesh> openmesh_decimated(const TriangleMesh& surface, std::int64_t triangles);

/// CGAL's edge_collapse by Garland and Heckbert's plane quadrics, with the filter that keeps
/// triangles from turning over.
std::optional<TriangleMesh> cgal_decimated(const TriangleMesh& surface, std::int64_t triangles);

/// meshoptimizer's meshopt_simplify, which works in floats and lets vertices stay where they are.
/// Only where Argil was built with it; the surface needs not be a two-manifold.
TriangleMesh meshoptimizer_decimated(const TriangleMesh& surface, std::int64_t triangles);
bool has_meshoptimizer() noexcept;

}  // namespace argil::evaluation
