// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush.h"

#include <algorithm>
#include <cmath>

namespace argil {

PosedTool::PosedTool(const Tool& tool, const DabPose& pose)
    : tool_(tool),
      center_(pose.position_mm),
      inverse_(conjugate(normalized(pose.orientation))),
      strength_(tool.strength * pose.pressure),
      shrink_mm_((1.0 - std::abs(strength_)) * smallest_radius(tool)) {
  // The half widths of a rotated ellipsoid's bounds: the lengths of the rows of R diag(radii).
  const Quat turn = normalized(pose.orientation);
  const Vec3 x = rotate(turn, Vec3{tool.radii_mm.x, 0.0, 0.0});
  const Vec3 y = rotate(turn, Vec3{0.0, tool.radii_mm.y, 0.0});
  const Vec3 z = rotate(turn, Vec3{0.0, 0.0, tool.radii_mm.z});
  Vec3 half;
  for (std::size_t a = 0; a < 3; ++a) half[a] = length(Vec3{x[a], y[a], z[a]});
  bounds_.include(center_ - half);
  bounds_.include(center_ + half);
}

double PosedTool::shrunk_distance(const Vec3& point_mm) const noexcept {
  if (tool_.shape == Shape::ball) {
    return length(point_mm - center_) - tool_.radii_mm.x + shrink_mm_;
  }
  return ellipsoid_distance(to_tool(point_mm), tool_.radii_mm) + shrink_mm_;
}

double PosedTool::falloff(const Vec3& point_mm) const noexcept {
  const Vec3 p = tool_.shape == Shape::ball ? point_mm - center_ : to_tool(point_mm);
  double square = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double r = p[a] / tool_.radii_mm[a];
    square += r * r;
  }
  const double rest = std::max(0.0, 1.0 - square);
  return rest * rest;
}

}  // namespace argil
