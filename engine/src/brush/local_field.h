// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/vec3.h"

#include "brush/leaf_feet.h"
#include "edit/level_edit.h"
#include "edit/stroke_start.h"

namespace argil {

/// A dense copy of one level about a tool, or of something made from it.
struct LocalField {
  openvdb::CoordBBox box;  ///< nodes of the level
  double voxel_mm = 0.0;
  std::vector<float> value;  ///< z fastest
};

/// The trilinear field at the feet of a leaf that are pulled, each shifted by `offset_mm`, to 1e-5
/// nodes of the field.
void read_at_feet(const LocalField& field, const LeafFeet& feet, const Vec3& offset_mm,
                  LeafMoves& out);

/// The level within the bounds and `margin` nodes around them, as the edit has it now.
LocalField local_field(const LevelEdit& level, const Box3& bounds_mm, int margin);

/// The nodes of `box` as a stroke found them, filled from coarser levels where there was no leaf.
LocalField local_field(const StrokeStart& start, double voxel_mm, int level,
                       const openvdb::CoordBBox& box);

/// The nodes of `box` as the stack has them, filled from coarser levels where there is no leaf.
LocalField local_field(const LevelStack& stack, int level, const openvdb::CoordBBox& box);

/// Averages the field twice with (1, 2, 1)/4 along each axis; the ends of each line stay.
void average_twice(LocalField& field);

/// Catmull-Rom along each axis, straight from the stack: slower than RowLoops::read_cubic for
/// points near each other, and without a limit to how far they lie apart.
float cubic_sample(const LevelStack& stack, int level, const Vec3& point_mm);

/// The plane that fits the surface under a tool.
struct LocalPlane {
  Vec3 center_mm;
  Vec3 normal;  ///< unit, outward

  double distance(const Vec3& point_mm) const noexcept { return dot(normal, point_mm - center_mm); }
};

}  // namespace argil
