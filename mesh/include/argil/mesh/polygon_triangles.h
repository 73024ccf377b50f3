// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// So many times, for each corner, may a triangulation ask how points lie. What programs make takes
/// a tenth of it; beyond are polygons in which each edge passes through all corners, or alike.
inline constexpr std::uint64_t kQuestionsPerCorner = 1000;

/// The inside of a polygon as triangles that are turned as it is, by the constrained Delaunay
/// triangulation of what is seen along the axis nearest to its normal. A point is inside when an
/// odd number of edges lies between it and the outside, so that an edge which is gone along twice,
/// as on a cut to a hole, bounds nothing. The triangles name corners by their number in
/// `corners`.
///
/// Shapes       three corners or more, finite.
/// Returns      nothing where the polygon has no inside of that kind: all corners on a line, or
///              edges that cross; and where it would take more than kQuestionsPerCorner.
/// Errors       throws std::bad_alloc: to be called within no_throw.
/// Determinism  same triangles every time.
/// Threads      any thread.
/// Cost         n log n for n corners, whatever their order: PolygonTriangles.* at the most corners
///              that are read.
/// Source       Boissonnat, Devillers, Pion, Teillaud, Yvinec: Triangulations in CGAL (2002).
///              Corners are inserted as Amenta, Choi and Rote have it (BRIO, 2003), edges scattered
///              as Shewchuk and Brown's random ones (2015).
std::vector<Triangle> triangulated(std::span<const Vec3> corners);

}  // namespace argil::mesh
