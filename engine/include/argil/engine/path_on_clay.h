// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil {

/// Whether a path lies on the clay: each of its points within 3 mm of the surface, or within three
/// voxels of the coarsest level where those are less, farther than which distances are not told
/// apart. A hand that is to follow another path would press where there is nothing.
///
/// Errors   bad_input naming the first point that is farther, its place and the remedy.
/// Threads  as Clay::distance_at.
/// Cost     that of Clay::distance_at for each point.
Result<void> check_path_on_clay(const Clay& clay, std::span<const Vec3> path_mm);

}  // namespace argil
