// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

#include "operations/body.h"
#include "operations/row.h"

namespace argil::evaluation {

/// What an operation was asked for, told by distances.
struct Truth {
  /// How far a point of the result is from where the operation asks it to be, mm, 0 or more.
  Distance error_mm;
  /// Whether a place is so near to a seam that it counts apart. None: there is no seam.
  std::function<bool(const Vec3&)> is_seam;
  /// Whether a vertex of the body should lie on the result. None: it is not asked.
  std::function<bool(const Vec3&)> stays;
};

/// The body itself: of import and resampling.
Truth as_it_was(const WorkedBody& body);
/// The exact Minkowski sum with a ball, or the difference: distance_mm from the body, outward
/// positive.
Truth moved_surface(const WorkedBody& body, double distance_mm);
/// The body's surface or, within, the one that leaves a wall.
Truth hollow_wall(const WorkedBody& body, double wall_mm);
/// The body united with its placed copy.
Truth united(const WorkedBody& body, const Placement& copy);

/// Over corners and centres of up to 200 000 triangles of a result. Spreads over TBB; the
/// same bits for any number of threads.
OperationError error_of(const TriangleMesh& result, const WorkedBody& body, const Truth& truth);

}  // namespace argil::evaluation
