// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil {

/// A half line, such as the one through the mouse's pixel.
struct Ray {
  Vec3 origin_mm;  ///< no coordinate beyond 1e9 finest voxels
  Vec3 direction;  ///< of any length but zero
};

/// Where a ray meets the surface.
struct Pick {
  Vec3 point_mm;
  Vec3 normal;  ///< unit, outward: grad phi by central differences over two voxels of `level`, as
                ///< the surface's normals are; -direction where those differences vanish
  double distance_mm = 0.0;  ///< from the ray's origin
  int level = 0;             ///< the finest one present there, whose voxels the point is on
};

/// The first point where a ray comes from outside into the clay: the front of what a camera sees. A
/// ray that starts in the clay first leaves it. Nothing when it never enters. SurfacePicker takes a
/// third to a fifth of the time, on the surface that is drawn.
///
/// Reads the clay as it stands, an open stroke included, and keeps nothing between calls: there is
/// nothing to bring up to date after an edit, and the answer depends on clay and ray alone.
///
/// Errors       bad_input for an origin or a direction that is not finite, an origin too far away,
///              or a direction of zero.
/// Accuracy     the field of Clay::distance_at changes sign within 1e-6 finest voxels of the point,
///              and no change before it is missed however thin the clay
///              (PickProperty.IsTheFirstEntryOfAFineMarch). Where levels meet that field may jump
///              over zero; elsewhere it is 0 at the point, to 1e-4 finest voxels.
/// Determinism  same bits for any number of threads and any history of the clay
///              (PickProperty.DoesNotDependOnHistory).
/// Threads      as Clay: its thread.
/// Cost         linear in the cells that the ray meets near the surface: some 15 us; the first one
///              after an edit 40 to 80, since it finds nothing in the caches (docs/sessions.md).
/// Source       docs/surface.md, "Picking".
Result<std::optional<Pick>> pick(const Clay& clay, const Ray& ray);

}  // namespace argil
