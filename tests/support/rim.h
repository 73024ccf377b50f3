// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil::test {

/// A ball about the origin from which another was cut, or to which it was added.
struct RimCase {
  double ball_mm = 0.0;
  Vec3 tool_at_mm;
  double tool_mm = 0.0;
  bool is_carved = false;
};

/// What rims are made on: a ball with voxels so fine that tools up to 16 mm have finer levels.
inline constexpr double kRimBall = 40.0;
inline constexpr double kRimVoxel = 0.25;
Clay rim_ball(std::optional<double> edge_radius_mm);

/// Three directions that no lattice favours, one of them nearly along an axis.
const std::vector<Vec3>& rim_directions();

/// Three kinds of rim, 58 to 96 degrees, in each direction. With a tool 8 voxels wide, where rims
/// are worst, nine cases that figures are about.
std::vector<RimCase> nine_rims(double tool_mm);
Stroke dab_of(const RimCase& rim);

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

/// rms of how much two rims differ, angle by angle.
double rms_between(const RimMeasure& a, const RimMeasure& b);

}  // namespace argil::test
