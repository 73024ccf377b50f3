// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil {

enum class Action { add, carve, smooth, inflate };
enum class Shape { ball, ellipsoid };

/// What a dab does and with which shape.
struct Tool {
  Action action = Action::add;
  Shape shape = Shape::ball;

  /// Semi-axes in mm, each > 0 and at most 20 times the smallest. A ball has three equal ones.
  Vec3 radii_mm{1.0, 1.0, 1.0};

  /// 0 < strength <= 1. add, carve: the shape is shrunk inward by (1 - strength) of its smallest
  /// radius. smooth: how far the surface goes to its smoothed self per dab. inflate: 1 moves the
  /// middle out by a quarter of the smallest radius per pass; negative strengths deflate.
  double strength = 1.0;
};

/// Where a tool is applied.
struct DabPose {
  Vec3 position_mm;
  Quat orientation;       ///< unit length
  double pressure = 1.0;  ///< 0 to 1, multiplies the strength
};

/// The smallest semi-axis in mm: what the level is chosen by.
inline double smallest_radius(const Tool& tool) noexcept {
  const Vec3& r = tool.radii_mm;
  return r.x < r.y ? (r.x < r.z ? r.x : r.z) : (r.y < r.z ? r.y : r.z);
}
inline double largest_radius(const Tool& tool) noexcept {
  const Vec3& r = tool.radii_mm;
  return r.x > r.y ? (r.x > r.z ? r.x : r.z) : (r.y > r.z ? r.y : r.z);
}

/// Success, or bad_input naming the field of `tool` that is out of its range and the range.
Result<void> validate_tool(const Tool& tool);

/// Signed distance in mm from `point_mm`, given in the frame of the tool (its centre at the origin,
/// its axes along x, y, z), to the surface of an ellipsoid; negative inside.
///
/// Accuracy  relative 1e-9 of the largest radius (bisection on the closest-point equation).
/// Cost      a ball one square root; an ellipsoid about 0.2 us.
/// Source    D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid",
///           2013. Ours takes a Newton step where it stays in the bracket.
double ellipsoid_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept;

}  // namespace argil
