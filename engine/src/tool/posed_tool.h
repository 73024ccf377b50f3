// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"

#include "field/level_stack.h"

namespace argil {

/// A tool on its path from one pose to another, ready to be evaluated at many nodes.
class PosedTool {
 public:
  PosedTool(const Tool& tool, const Dab& dab);

  const Tool& tool() const noexcept { return tool_; }
  const Dab& dab() const noexcept { return dab_; }
  double strength() const noexcept { return strength_; }  ///< of the tool as the pressure has it
  const Vec3& radii_mm() const noexcept { return radii_mm_; }  ///< likewise
  double smallest_radius_mm() const noexcept { return smallest_mm_; }
  double shrunk_radius_mm() const noexcept { return smallest_mm_ - shrink_mm_; }
  /// How deep the shrunk shape is at most, anywhere on the path: a point in it lies no farther from
  /// its surface.
  double deepest_mm() const noexcept;
  /// How far the tool reaches from its path, in its largest radii: 1, but for square tips.
  double reach() const noexcept { return reach_; }
  /// Of all that it reaches from the path.
  const Box3& bounds_mm() const noexcept { return bounds_; }

  /// Signed distance to what the shape, shrunk by (1 - strength) of its smallest radius, sweeps;
  /// negative inside. Exact for balls and where the sweep is one pose; else the path is cut in
  /// pieces so short that the union of poses misses it by 1/1000 of the smallest radius.
  double shrunk_distance(const Vec3& point_mm) const noexcept;

  /// The same at the nodes of a leaf. A ball's to the rounding of float.
  void shrunk_distances(const Coord& origin, double voxel_mm, LeafValues& out) const noexcept;

  /// How that grows, per mm, at any point but those as far from several parts of the shape: a unit
  /// vector, to 1/1000 for shapes that are not balls.
  Vec3 slope(const Vec3& point_mm) const noexcept;

  /// Where the falloff has its middle: halfway, so that dabs far apart add up to what near ones do;
  /// of anchored actions at the last pose.
  const Vec3& middle_mm() const noexcept { return middle_; }

  /// A vector along the tool's own axes, each in radii of the tool.
  Vec3 in_radii(const Vec3& vector_mm) const noexcept;
  /// And back.
  Vec3 from_radii(const Vec3& vector) const noexcept;

  /// The tool's falloff from its middle.
  double falloff(const Vec3& point_mm) const noexcept;

 private:
  /// One pose of a shape that is not a ball, with the shape's size there.
  struct Placed {
    Vec3 center;
    Quat inverse;
    Vec3 radii_mm;
    double shrink_mm;
  };
  double placed_distance(const Placed& at, const Vec3& point_mm) const noexcept;
  double ball_distance(const Vec3& point_mm) const noexcept;
  /// How far along the path, 0 to 1, the ball's nearest place is, for a point counted from the
  /// path's begin.
  double nearest_on_path(const Vec3& from) const noexcept;
  void include_bounds(const DabPose& pose);
  void place_ball();
  void place_pieces();
  Vec3 sized(double pressure) const noexcept;
  double shrink_of(double pressure) const noexcept;

  Tool tool_;
  Dab dab_;
  double strength_;
  Vec3 radii_mm_;
  double smallest_mm_;
  double shrink_mm_;
  double reach_;
  Quat inverse_;
  Vec3 middle_;
  Box3 bounds_;

  // A ball: a cone with round ends, from the first radius to the last.
  Vec3 axis_;  ///< unit, along the path; zero when it stays
  double path_mm_ = 0.0;
  double first_radius_mm_ = 0.0;
  double last_radius_mm_ = 0.0;
  double lean_ = 0.0;  ///< tangent of the angle between the cone's side and its axis

  std::vector<Placed> pieces_;
};

/// What a vector or a point of a dab is of its image, and the other way.
Vec3 turned(const Dab& image, Vec3 vector) noexcept;
Vec3 unturned(const Dab& image, const Vec3& vector) noexcept;

/// What a tool does to a whole leaf, when its distance to the leaf's middle already says so.
enum class Cover { none, all, some };
Cover cover_of(const Coord& origin, double voxel_mm, double band_mm,
               const PosedTool& tool) noexcept;

}  // namespace argil
