// SPDX-License-Identifier: GPL-3.0-or-later
// The entry point of a ray and the normal there, by central differences.
#include "argil/engine/pick.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "clay/clay_access.h"
#include "raycast/field_ray.h"

namespace argil {
namespace {

/// Beyond, doubles could not represent a point along the ray to a millionth of a voxel.
constexpr double kFarthestVoxels = 1e9;

double largest_component(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Before anything is computed with its numbers.
Result<void> validate_ray(const Ray& ray, double voxel_mm) {
  const Vec3& o = ray.origin_mm;
  const Vec3& d = ray.direction;
  std::ostringstream message;
  if (!is_finite(o)) {
    message << "origin_mm is " << o.x << ", " << o.y << ", " << o.z << "; must be finite numbers";
  } else if (largest_component(o) > kFarthestVoxels * voxel_mm) {
    message << "origin_mm has a coordinate of " << largest_component(o) << " mm; with a voxel of "
            << voxel_mm << " mm it may be at most " << kFarthestVoxels * voxel_mm << " mm";
  } else if (!is_finite(d) || d == Vec3{}) {
    message << "direction is " << d.x << ", " << d.y << ", " << d.z
            << "; must be finite numbers that are not all 0";
  } else {
    return {};
  }
  return Error{ErrorKind::bad_input, message.str()};
}

/// Of unit length, also where the squares of the components would overflow or vanish.
Vec3 unit(const Vec3& direction) noexcept {
  const double most = largest_component(direction);
  assert(most > 0.0 && std::isfinite(most));
  return normalized(Vec3{direction.x / most, direction.y / most, direction.z / most});
}

Vec3 central_differences(const Clay& clay, const Vec3& point_mm, double step_mm) {
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = step_mm;
    slope[axis] = clay.distance_at(point_mm + step) - clay.distance_at(point_mm - step);
  }
  return slope;
}

}  // namespace

Result<std::optional<Pick>> pick(const Clay& clay, const Ray& ray) {
  const LevelStack& stack = levels_of(clay);
  const double voxel_mm = stack.voxel_mm(0);
  if (auto ok = validate_ray(ray, voxel_mm); !ok) return ok.error();
  const Vec3 direction = unit(ray.direction);
  const Vec3& o = ray.origin_mm;
  const Vec3 origin{o.x / voxel_mm, o.y / voxel_mm, o.z / voxel_mm};
  const auto entry = first_entry(stack, origin, direction);
  if (!entry) return std::optional<Pick>();
  Pick pick;
  pick.distance_mm = entry->along * voxel_mm;
  pick.point_mm = o + pick.distance_mm * direction;
  assert(is_finite(pick.point_mm));
  pick.level = entry->level;
  pick.normal = normalized(central_differences(clay, pick.point_mm, stack.voxel_mm(entry->level)));
  if (pick.normal == Vec3{}) pick.normal = -direction;
  return std::optional(pick);
}

}  // namespace argil
