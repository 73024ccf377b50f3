// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/path_on_clay.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace argil {

Result<void> check_path_on_clay(const Clay& clay, std::span<const Vec3> path_mm) {
  constexpr double kMostMm = 3.0;
  constexpr double kMostVoxels = 3.0;
  const double coarsest_mm = std::ldexp(clay.options().voxel_mm, clay.level_count() - 1);
  const double most_mm = std::min(kMostMm, kMostVoxels * coarsest_mm);
  for (std::size_t n = 0; n < path_mm.size(); ++n) {
    const Vec3& point = path_mm[n];
    if (std::abs(clay.distance_at(point)) <= most_mm) continue;
    std::ostringstream text;
    text << "point " << n + 1 << " of the path, (" << point.x << ", " << point.y << ", " << point.z
         << ") mm, lies more than " << most_mm
         << " mm from the clay's surface; draw it on the clay";
    return Error{ErrorKind::bad_input, text.str()};
  }
  return {};
}

}  // namespace argil
