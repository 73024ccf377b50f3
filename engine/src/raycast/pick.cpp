// SPDX-License-Identifier: GPL-3.0-or-later
// The entry point of a ray and the normal there, by central differences.
#include "argil/engine/pick.h"

#include <cassert>

#include "clay/clay_access.h"
#include "raycast/checked_ray.h"
#include "raycast/field_ray.h"

namespace argil {
namespace {

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
  const Vec3 direction = unit_direction(ray);
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
