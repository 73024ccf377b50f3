// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {

/// Where two things come nearest.
struct ClosestPoints {
  double distance2 = 0.0;
  Vec3 a;  ///< on the first
  Vec3 b;
};

/// Of two triangles, which may be segments or points; distance 0 where they cross.
/// Source  C. Ericson, "Real-Time Collision Detection", 2005, 5.1: points, segments and triangles.
ClosestPoints closest_points(const Corners& a, const Corners& b) noexcept;

}  // namespace argil::mesh
