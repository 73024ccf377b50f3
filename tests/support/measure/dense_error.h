// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/certificate.h"

namespace argil::test {

/// What io::measure_error measures, by another way that shares no code with it: points on a dense
/// lattice over every triangle, points with phi = 0 by bisection of Clay::distance_at on lines,
/// each anywhere in its square of a dense lattice, and the nearest triangle from a grid of buckets.
/// The greatest distance is then sought where it may lie, by cubes down to a sixty-fourth of a
/// voxel.
///
/// `step_mm` between points. Cost about 5 us a point.
mesh::MeshError dense_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            double step_mm);

}  // namespace argil::test
