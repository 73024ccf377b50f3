// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/stability_served.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "served_clay.h"

namespace argil::cli::chart {
namespace {

/// What a limit cycle of the push hand moves between two windows.
constexpr double kMarginMm = 4.0;

/// Half sides of clay so large that the tool, its kernel and its skin feel nothing but the plane.
Vec3 half_size_mm(const ServedOptions& options) {
  const double reach_mm = haptics::kKernelSupport * options.radius_mm + 10.0;
  const double aside_mm = reach_mm + std::min(options.material.skin_mm, 10.0);
  return {aside_mm + 0.5 * options.way_mm, reach_mm, aside_mm};
}

Result<Clay> flat_clay(const ServedOptions& options) {
  ClayOptions clay;
  clay.voxel_mm = kServedVoxelMm;
  const Vec3 half_mm = half_size_mm(options);
  if (options.tilt_rad == 0.0) return Clay::block(2.0 * half_mm, clay);
  const Vec3 normal = served_normal(options.tilt_rad);
  const double side_mm = length(half_mm);
  const Box3 bounds{-Vec3{side_mm, side_mm, side_mm}, {side_mm, side_mm, side_mm}};
  // The plane through the origin, cut off well inside the bounds.
  const auto distance_mm = [normal, side_mm](const Vec3& place) {
    return std::max(dot(normal, place), length(place) - (side_mm - 8.0 * kServedVoxelMm));
  };
  return Clay::from_distance(distance_mm, bounds, clay);
}

ClayWorkerOptions worker_options(const ServedOptions& options) {
  ClayWorkerOptions worker;
  const double radius_mm = options.radius_mm;
  worker.tool = {Action::carve, Shape::ball, {radius_mm, radius_mm, radius_mm}, 1.0};
  worker.refresh_s = options.refresh_s;
  return worker;
}

haptics::ClaySceneOptions scene_options(const ServedOptions& options, const Vec3& offset_mm) {
  haptics::ClaySceneOptions scene;
  scene.tool.radii_mm = {options.radius_mm, options.radius_mm, options.radius_mm};
  scene.material = options.material;
  scene.offset_mm = offset_mm;
  // The whole margin would give the finest tools windows of 60 nodes a side.
  scene.margin_mm = std::min(kMarginMm, 4.0 * options.radius_mm);
  return scene;
}

}  // namespace

Result<std::unique_ptr<ServedClay>> ServedClay::make(const ServedOptions& options) {
  auto clay = flat_clay(options);
  if (!clay) return clay.error();
  const double top_mm = options.tilt_rad == 0.0 ? half_size_mm(options).y : 0.0;
  return std::unique_ptr<ServedClay>(
      new ServedClay(std::move(clay).value(), options, {0.0, top_mm, 0.0}));
}

ServedClay::ServedClay(Clay clay, const ServedOptions& options, const Vec3& offset_mm)
    : clay_(std::move(clay)),
      ring_(kClayRingSamples),
      worker_(clay_, worker_options(options), ring_, channel_),
      scene_(scene_options(options, offset_mm), ring_, channel_) {}

void ServedClay::after_tick(const haptics::ServoTick& tick) {
  if (tick.window.sequence > 0) faults_ |= tick.faults;
  step(tick.time_s);
}

void ServedClay::step(double now_s) {
  if (now_s < next_step_s_ || !worked_) return;
  next_step_s_ += kClayStepS;
  if (auto stepped = worker_.step(); !stepped) worked_ = stepped.error();
}

Vec3 served_normal(double tilt_rad) {
  const double s = std::sin(tilt_rad);
  const double c = std::cos(tilt_rad);
  return {s, c * c, s * c};
}

}  // namespace argil::cli::chart
