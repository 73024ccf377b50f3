// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil::evaluation {

/// A crease or a ridge along a great circle of a ball about the origin.
struct CreaseLine {
  double ball_mm;
  Vec3 normal;        ///< of the circle's plane, unit
  Vec3 middle;        ///< unit, in that plane: where the part that is measured has its middle,
  double half_angle;  ///< and how far it reaches to either side
  double tool_mm;
  double side = 1.0;  ///< -1: a ridge
};

/// What sections across the line have in the mean.
struct CreaseShape {
  double depth_mm = 0.0;
  double width_mm = 0.0;  ///< at half the depth
  /// How far the surface rises within 0.06 tool radii of its deepest point, over what a V as deep
  /// and as wide at half its depth would: 1 for a V.
  double sharpness = 0.0;
  /// Of how deep the sections are, along the line: what a mean over a tool's radius to either side
  /// leaves of it, as a root of the mean square.
  double bottom_rms_mm = 0.0;
};

CreaseShape crease_shape(const TriangleMesh& mesh, const CreaseLine& line);

}  // namespace argil::evaluation
