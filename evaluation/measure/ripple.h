// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

/// How rough a surface is at a scale: points spread evenly over its triangles, each compared with
/// the paraboloid that fits the points within `reach_mm` of it, as a root of the mean square. What
/// bends over more than a few `reach_mm` counts nothing; a step, an edge or a ripple does, and so
/// do large facets. Independent of how many triangles there are.
///
/// Shapes   any mesh; `is_looked_at` picks the points that are compared, by place. 0 where it picks
///          none.
/// Units    mm; reach_mm above 0.
/// Threads  any. Linear in the area that is looked at over reach_mm squared.
double ripple_rms(const TriangleMesh& mesh, double reach_mm,
                  const std::function<bool(const Vec3&)>& is_looked_at);

}  // namespace argil::evaluation
