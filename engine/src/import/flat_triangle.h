// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

#include "rows/rows.h"

namespace argil {

/// A triangle with what its distance is measured by. Its plane is spanned from its longest side, so
/// that one of nearly no height is as exact as others.
class FlatTriangle {
 public:
  /// Corners in mm, from any origin; of any area.
  FlatTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double voxel_mm) noexcept;

  const Box3& bounds_mm() const noexcept { return bounds_mm_; }

  /// Whether it may come as near as `reach_voxels` to a node of a cube of nodes, by its middle and
  /// half its side. Never says no where it does.
  bool may_reach(const Vec3& middle_mm, double half_voxels, double reach_voxels) const noexcept;

  /// A ball around it, from that point, in voxels.
  struct Ball {
    std::array<float, 3> at;
    float radius;
  };
  Ball ball_from(const Vec3& origin_mm) const noexcept;

  /// As seen from the leaf whose first node is at `origin_mm`, for distances up to `reach_voxels`.
  LeafTriangle seen_from(const Vec3& origin_mm, double reach_voxels) const noexcept;

 private:
  /// Along a unit vector from a corner, at an offset from it in voxels.
  static LatticeFunction function(const Vec3& unit, const Vec3& offset) noexcept;
  Vec3 offset_from(std::size_t corner, const Vec3& point_mm) const noexcept;

  double voxel_mm_;
  Vec3 normal_;
  std::array<Vec3, 3> outward_;  ///< of each side, within the plane; zero where it has no length
  std::array<Vec3, 3> along_;
  std::array<Vec3, 3> corner_mm_;        ///< where each side begins
  std::array<double, 3> length_voxels_;  ///< of each side
  Box3 bounds_mm_;
};

}  // namespace argil
