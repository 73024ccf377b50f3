// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/measure_pick.h"

#include <cassert>
#include <cmath>

#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

/// The part of a ray that a slice leaves: from `from_mm` on, up to `to_mm`.
struct SeenRay {
  double from_mm = 0.0;
  double to_mm = HUGE_VAL;
};

/// Nothing where all of it is cut away.
std::optional<SeenRay> seen_part(const Ray& ray, const std::optional<SeenHalf>& seen) {
  if (!seen) return SeenRay{};
  assert(std::abs(length(seen->normal) - 1.0) < 1e-6);
  const double above = dot(seen->normal, ray.origin_mm) - seen->offset_mm;
  const double slope = dot(seen->normal, ray.direction);
  if (above >= 0.0) return SeenRay{0.0, slope < 0.0 ? -above / slope : HUGE_VAL};
  if (slope <= 0.0) return std::nullopt;
  return SeenRay{-above / slope, HUGE_VAL};
}

/// Errors of a ray that no clay takes, such as one from too far away, are those of one that misses.
std::optional<Pick> first_entry(const Clay& clay, const Ray& ray) {
  const auto picked = pick(clay, ray);
  return picked ? picked.value() : std::nullopt;
}

}  // namespace

std::optional<MeasuredPick> measure_pick(const Sculpture& sculpture, const Ray& ray,
                                         const std::optional<SeenHalf>& seen) {
  const double scale = length(ray.direction);
  if (!(scale > 0.0) || !std::isfinite(scale)) return std::nullopt;
  const Ray unit{ray.origin_mm, (1.0 / scale) * ray.direction};
  const auto part = seen_part(unit, seen);
  if (!part) return std::nullopt;
  const Vec3 start = unit.origin_mm + part->from_mm * unit.direction;
  std::optional<MeasuredPick> nearest;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    if (!sculpture.look(n).is_visible) continue;
    const Placement& at = sculpture.look(n).placement;
    const Clay& clay = sculpture.clay(n);
    const Vec3 own_start = unplaced(at, start);
    // Where the slice lies in material that is the first thing to be seen.
    if (part->from_mm > 0.0 && clay.distance_at(own_start) < 0.0) {
      const Vec3 to_eye = -1.0 * seen->normal;
      return MeasuredPick{n, own_start, turned_back(at, to_eye), part->from_mm, true};
    }
    const auto picked = first_entry(clay, {own_start, turned_back(at, unit.direction)});
    if (!picked) continue;
    const double distance = part->from_mm + picked->distance_mm;
    if (distance > part->to_mm || (nearest && distance >= nearest->distance_mm)) continue;
    nearest = MeasuredPick{n, picked->point_mm, picked->normal, distance, false};
  }
  return nearest;
}

/// argil::pick tells where a ray enters. A line from inside goes out and may enter again: what lies
/// before that second entry is air up to the exit that is looked for, which a ray that comes back
/// through this air enters by.
std::optional<Vec3> far_side(const Clay& clay, const Vec3& point_mm, const Vec3& normal) {
  assert(std::abs(length(normal) - 1.0) < 1e-6);
  const double voxel = clay.options().voxel_mm;
  const Vec3 inward = -1.0 * normal;
  const Vec3 inside = point_mm + 0.01 * voxel * inward;
  if (!(clay.distance_at(inside) < 0.0)) return std::nullopt;
  const auto next = first_entry(clay, {inside, inward});
  const Vec3 size = clay.bounds_mm().size();
  const double beyond = length(size) + 4.0 * voxel;  // than any point of the clay
  const double air = next ? next->distance_mm - 1e-3 * voxel : beyond;
  const auto back = first_entry(clay, {inside + air * inward, normal});
  if (!back || back->distance_mm > air) return std::nullopt;
  return back->point_mm;
}

bool is_still_there(const Clay& clay, const MeasurePoint& point) {
  constexpr double kSurfaceVoxels = 0.5;
  constexpr double kSliceVoxels = 2.0;  // its outline is read from a picture
  const double voxels = clay.distance_at(point.own_mm) / clay.options().voxel_mm;
  return point.is_within ? voxels < kSliceVoxels : std::abs(voxels) < kSurfaceVoxels;
}

}  // namespace argil::viewer
