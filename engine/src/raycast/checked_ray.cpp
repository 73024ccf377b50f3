// SPDX-License-Identifier: GPL-3.0-or-later
#include "raycast/checked_ray.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

namespace argil {
namespace {

/// Beyond, doubles could not represent a point along the ray to a millionth of a voxel.
constexpr double kFarthestVoxels = 1e9;

double largest_component(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

Result<void> validate_ray(const Ray& ray, double voxel_mm) {
  const Vec3& o = ray.origin_mm;
  const Vec3& d = ray.direction;
  const bool is_near = is_finite(o) && largest_component(o) <= kFarthestVoxels * voxel_mm;
  if (is_near && is_finite(d) && d != Vec3{}) return {};
  std::ostringstream message;
  if (!is_finite(o)) {
    message << "origin_mm is " << o.x << ", " << o.y << ", " << o.z << "; must be finite numbers";
  } else if (!is_near) {
    message << "origin_mm has a coordinate of " << largest_component(o) << " mm; with a voxel of "
            << voxel_mm << " mm it may be at most " << kFarthestVoxels * voxel_mm << " mm";
  } else {
    message << "direction is " << d.x << ", " << d.y << ", " << d.z
            << "; must be finite numbers that are not all 0";
  }
  return Error{ErrorKind::bad_input, message.str()};
}

Vec3 unit_direction(const Ray& ray) noexcept {
  const Vec3& d = ray.direction;
  const double most = largest_component(d);
  assert(most > 0.0 && std::isfinite(most));
  return normalized(Vec3{d.x / most, d.y / most, d.z / most});
}

}  // namespace argil
