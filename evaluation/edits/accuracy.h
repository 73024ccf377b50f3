// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/core/triangle_mesh.h"

#include "edits/row.h"
#include "edits/stroke_plan.h"

namespace argil::evaluation {

/// What a stroke changes lies within so many radii of its path: it raises the surface by half a
/// one.
inline constexpr double kStrokeReach = 1.25;

/// The triangles of a mesh with a corner within so many radii of a stroke, and their vertices.
TriangleMesh part_near_stroke(const TriangleMesh& mesh, const StrokePlan& plan, double radii);

/// How far two meshes lie apart where a stroke went: from the vertices of each to the triangles of
/// the other, the worse of both for each figure. Of many vertices every so many is looked at.
///
/// Threads  any; uses TBB. Same figures for any number of threads.
DistanceSpread spread_between(const TriangleMesh& a, const TriangleMesh& b, const StrokePlan& plan);

/// A shape by a function that is zero on its surface, negative inside.
using ShapeFunction = std::function<double(const Vec3&)>;

/// How far a mesh lies from a shape, likewise. From mesh to shape it is the function's value over
/// its slope; for the way back, the vertices of `finer` that the shape passes near are moved onto
/// it.
DistanceSpread spread_to_shape(const TriangleMesh& mesh, const TriangleMesh& finer,
                               const ShapeFunction& shape, const StrokePlan& plan);

/// The longest edge of a mesh where a stroke went.
double longest_edge_mm(const TriangleMesh& mesh, const StrokePlan& plan);

}  // namespace argil::evaluation
