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

std::array<float, kLeafSide> PosedTool::shrunk_distances(const Vec3& first_mm,
                                                         double step_mm) const noexcept {
  std::array<float, kLeafSide> out;
  if (tool_.shape != Shape::ball) {
    for (int z = 0; z < kLeafSide; ++z) {
      const Vec3 at{first_mm.x, first_mm.y, first_mm.z + step_mm * z};
      out[static_cast<std::size_t>(z)] = static_cast<float>(shrunk_distance(at));
    }
    return out;
  }
  const Vec3 from = first_mm - center_;
  const auto beside = static_cast<float>(from.x * from.x + from.y * from.y);
  const auto low = static_cast<float>(from.z);
  const auto step = static_cast<float>(step_mm);
  const auto radius = static_cast<float>(tool_.radii_mm.x - shrink_mm_);
  for (int z = 0; z < kLeafSide; ++z) {
    const float along = low + step * static_cast<float>(z);
    out[static_cast<std::size_t>(z)] = std::sqrt(beside + along * along) - radius;
  }
  return out;
}

Cover cover_of(const Coord& place, double voxel_mm, double band_mm,
               const PosedTool& tool) noexcept {
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm;
  const Vec3 middle{voxel_mm * place.x() + half, voxel_mm * place.y() + half,
                    voxel_mm * place.z() + half};
  const double distance = tool.shrunk_distance(middle);
  const double reach = half * std::sqrt(3.0) + band_mm;
  if (distance > reach) return Cover::none;
  return distance < -reach ? Cover::all : Cover::some;
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
