// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"
#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"

#include "level_edit.h"

namespace argil {

/// A tool at a pose, ready to be evaluated at many nodes.
class PosedTool {
 public:
  PosedTool(const Tool& tool, const DabPose& pose);

  const Tool& tool() const noexcept { return tool_; }
  double strength() const noexcept { return strength_; }  ///< of the tool times the pressure
  const Box3& bounds_mm() const noexcept { return bounds_; }

  /// Signed distance to the shape shrunk by (1 - strength) of its smallest radius, negative inside.
  double shrunk_distance(const Vec3& point_mm) const noexcept;

  /// The same for a row of a leaf: at `first_mm` and on along z, `step_mm` apart. A ball's to the
  /// rounding of float.
  std::array<float, kLeafSide> shrunk_distances(const Vec3& first_mm,
                                                double step_mm) const noexcept;

  /// (1 - r^2)^2 with r the distance from the centre in radii; 0 outside. Smooth, 1 in the middle.
  double falloff(const Vec3& point_mm) const noexcept;

 private:
  Vec3 to_tool(const Vec3& point_mm) const noexcept { return rotate(inverse_, point_mm - center_); }
  Tool tool_;
  Vec3 center_;
  Quat inverse_;
  double strength_;
  double shrink_mm_;
  Box3 bounds_;
};

/// What a tool does to a whole leaf, when its distance to the leaf's middle already says so.
enum class Cover { none, all, some };
Cover cover_of(const Coord& place, double voxel_mm, double band_mm, const PosedTool& tool) noexcept;

/// Each brush writes `now` of every leaf of one level from `before`; pure: no history, no input
/// handling. Values are clamped to the band.

/// Union with the tool, or with its complement cut away. Exact distance stays exact outside the
/// union and a lower bound inside, so the level needs no solving afterwards.
void stamp_add(LevelEdit& level, const PosedTool& tool);
void stamp_carve(LevelEdit& level, const PosedTool& tool);

/// Moves the surface outward by `amount_mm` in the middle of the tool (inward when negative), at
/// most 1.5 voxels of the level at a time.
void stamp_inflate(LevelEdit& level, const PosedTool& tool, double amount_mm);

/// The field that `stamp_smooth` draws the surface to: the tool's own level averaged twice with
/// (1, 2, 1)/4 along each axis, around the tool.
struct SmoothTarget {
  openvdb::CoordBBox box;  ///< nodes of the tool's level
  double voxel_mm = 0.0;
  std::vector<float> value;                       ///< z fastest
  float at(const Vec3& point_mm) const noexcept;  ///< trilinear; clamped to the box
};
SmoothTarget smooth_target(const LevelEdit& level, const Box3& bounds_mm);

/// Draws the surface towards `target` by strength times falloff in `steps` equal shares, this being
/// one, at most 1.5 voxels of the level at a time. Finer levels are drawn to the same target, so
/// that a large tool smooths fine detail away at its own scale. Returns the farthest, in mm, that a
/// node within the band would have moved without that limit.
float stamp_smooth(LevelEdit& level, const PosedTool& tool, const SmoothTarget& target, int steps);

/// Calls visit(point_mm, before) -> float for every node and stores the clamped result in `now`.
template <class Visit>
void rewrite_nodes(LeafEdit& leaf, double voxel_mm, float band, Visit&& visit) {
  std::size_t n = 0;
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      for (int k = 0; k < kLeafSide; ++k, ++n) {
        const Vec3 point{voxel_mm * (leaf.place.x() + i), voxel_mm * (leaf.place.y() + j),
                         voxel_mm * (leaf.place.z() + k)};
        const float value = visit(point, leaf.before[n]);
        leaf.now[n] = value < -band ? -band : (value > band ? band : value);
      }
    }
  }
}

}  // namespace argil
