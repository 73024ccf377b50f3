// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::evaluation {

/// A ball about the origin from which another was cut, or to which it was added.
struct RimCase {
  double ball_mm = 0.0;
  Vec3 tool_at_mm;
  double tool_mm = 0.0;
  bool is_carved = false;
};

/// How a mesh shows the circle in which both meet; all in mm.
struct RimMeasure {
  /// Of the mesh within 2 voxels of the circle, the distance from the exact shape.
  double surface_rms = 0.0;
  /// How far the mesh's edge is beyond the circle, along the bisector of both surfaces, by angle
  /// about the axis: of the convex edge of a cut the highest point, of a concave one the deepest.
  std::vector<double> beyond;

  /// Its mean, and the rms of what it differs from that: the saw.
  double mean() const;
  double serration_rms() const;
};

/// `voxel_mm`: of the level that the tool is written at, the unit of both ranges.
RimMeasure measure_rim(const TriangleMesh& mesh, const RimCase& rim, double voxel_mm);

}  // namespace argil::evaluation
