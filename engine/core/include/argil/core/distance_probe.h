// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil {

/// What a distance field says at a point.
struct FieldValue {
  /// Signed distance to the surface in mm, negative inside.
  double distance_mm = 0.0;
  /// Gradient of the interpolated values, without unit; zero far from the surface.
  Vec3 gradient;
  /// Spacing in mm of the values that the answer comes from.
  double voxel_mm = 0.0;
};

/// A signed distance field that is asked at many points, one after another. An implementation may
/// remember the surroundings of the last one.
///
/// Threads      one thread each; make as many as there are threads.
class DistanceProbe {
 public:
  virtual ~DistanceProbe() = default;

  /// The signed distance in mm. `point_mm` must be finite; so is what comes back.
  virtual double distance_mm(const Vec3& point_mm) = 0;
  /// The distance with its gradient and voxel size, under the same condition.
  virtual FieldValue value(const Vec3& point_mm) = 0;
};

}  // namespace argil
