// SPDX-License-Identifier: GPL-3.0-or-later
// Flat clay as the program serves it: a real clay, its worker and windows, stepped on virtual time.
#include "stability/flat_clay.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace argil::evaluation {
namespace {

/// What a limit cycle of the push hand moves between two windows.
constexpr double kMarginMm = 4.0;

/// Half sides of clay so large that the tool, its kernel and its skin feel nothing but the plane.
Vec3 half_size_mm(const FlatClayOptions& options) {
  const double reach_mm = haptics::kKernelSupport * options.radius_mm + 10.0;
  const double aside_mm = reach_mm + std::min(options.material.skin_mm, 10.0);
  return {aside_mm + 0.5 * options.path_mm, reach_mm, aside_mm};
}

Result<Clay> make_flat_clay(const FlatClayOptions& options) {
  ClayOptions clay;
  clay.voxel_mm = kFlatVoxelMm;
  const Vec3 half_mm = half_size_mm(options);
  if (options.tilt_rad == 0.0) return Clay::block(2.0 * half_mm, clay);
  const Vec3 normal = leaning_normal(options.tilt_rad);
  const double side_mm = length(half_mm);
  const Box3 bounds{-Vec3{side_mm, side_mm, side_mm}, {side_mm, side_mm, side_mm}};
  // The plane through the origin, cut off well inside the bounds.
  const auto distance_mm = [normal, side_mm](const Vec3& point) {
    return std::max(dot(normal, point), length(point) - (side_mm - 8.0 * kFlatVoxelMm));
  };
  return Clay::from_distance(distance_mm, bounds, clay);
}

ClayWorkerOptions worker_options(const FlatClayOptions& options) {
  ClayWorkerOptions worker;
  const double radius_mm = options.radius_mm;
  worker.tool = {Action::carve, Shape::ball, {radius_mm, radius_mm, radius_mm}, 1.0};
  worker.refresh_s = options.refresh_s;
  return worker;
}

haptics::ClaySceneOptions scene_options(const FlatClayOptions& options, const Vec3& offset_mm) {
  haptics::ClaySceneOptions scene;
  scene.tool.radii_mm = {options.radius_mm, options.radius_mm, options.radius_mm};
  scene.material = options.material;
  scene.own_cut_mm = options.radius_mm;
  scene.offset_mm = offset_mm;
  // The whole margin would give the finest tools windows of 60 nodes a side.
  scene.margin_mm = std::min(kMarginMm, 4.0 * options.radius_mm);
  return scene;
}

}  // namespace

Result<std::unique_ptr<FlatClay>> FlatClay::make(const FlatClayOptions& options) {
  assert(options.radius_mm > 0.0 && options.material.skin_mm > 0.0 && options.path_mm >= 0.0);
  auto clay = make_flat_clay(options);
  if (!clay) return clay.error();
  const double top_mm = options.tilt_rad == 0.0 ? half_size_mm(options).y : 0.0;
  return std::unique_ptr<FlatClay>(
      new FlatClay(std::move(clay).value(), options, {0.0, top_mm, 0.0}));
}

FlatClay::FlatClay(Clay clay, const FlatClayOptions& options, const Vec3& offset_mm)
    : clay_(std::move(clay)),
      served_(clay_, worker_options(options), scene_options(options, offset_mm)) {}

void FlatClay::after_tick(const haptics::ServoTick& tick) {
  if (tick.window.sequence > 0) faults_ |= tick.faults;
  step(tick.time_s);
}

void FlatClay::step(double now_s) {
  if (!worked_) return;
  worked_ = served_.after_tick(now_s);
}

Vec3 leaning_normal(double tilt_rad) {
  const double s = std::sin(tilt_rad);
  const double c = std::cos(tilt_rad);
  return {s, c * c, s * c};
}

}  // namespace argil::evaluation
