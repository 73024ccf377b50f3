// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"

#include "brush/local_field.h"
#include "rows/rows.h"
#include "tool/posed_tool.h"

namespace argil {

/// A piece of the path of a profiled action: a profile, a V with a rounded point, along a straight
/// line over the surface. The middle sinks by a quarter of the smallest radius times the strength;
/// both change evenly from one end's pressure to the other's.
class ProfilePiece {
 public:
  /// `side`: 1 sinks, -1 raises. The point is rounded over `least_round_mm` to either side at
  /// least, or no lattice would hold it.
  ProfilePiece(const PosedTool& tool, const LocalPlane& plane, double side, double least_round_mm);

  /// Where a point lies: how far beside the line, within the plane, and how far over the plane that
  /// holds its first point.
  struct Place {
    double beside_mm;
    double up_mm;
  };
  Place place_of(const Vec3& point_mm) const noexcept;

  const Vec3& normal() const noexcept { return normal_; }
  /// How far the surface sinks, or rises, above or below a point.
  double sunk_mm(const Vec3& point_mm) const noexcept;
  double side() const noexcept { return side_; }
  double most_depth_mm() const noexcept { return most_depth_; }
  double half_width_mm() const noexcept { return most_width_; }
  /// How far off the line along the normal the surface may lie.
  double reach_mm() const noexcept { return reach_; }
  /// Holds all points so near to the line where it lies on the plane: beside it within the plane,
  /// and off the plane.
  Box3 bounds_mm(double beside_mm, double up_mm) const noexcept;

  /// For the leaf of a level; `known_mm`: starts as far from the surface are cut short.
  ProfileJob job_of(const Coord& origin, double voxel_mm, float band_mm,
                    float known_mm) const noexcept;

 private:
  struct End {
    double scale;
    double half_width;
  };
  End end_of(const PosedTool& tool) const noexcept;

  Vec3 from_;
  Vec3 normal_;
  Vec3 path_;  ///< within the plane
  double above_;
  double side_;
  double round_;
  double reach_;
  double most_depth_;
  double most_width_;
  std::array<End, 2> ends_;
};

}  // namespace argil
