// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes whose distance has a closed form.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "scene/scene.h"

namespace argil::evaluation {
namespace {

/// The step of gradients, in mm: small against every curvature here, large against rounding.
constexpr double kProbeMm = 1e-4;

/// Every body lies askew to the lattice.
const Quat kTilt = normalized(Quat{0.83, 0.31, -0.27, 0.37});

Box3 bounds_of(double half_mm) {
  return {{-half_mm, -half_mm, -half_mm}, {half_mm, half_mm, half_mm}};
}

/// A body in its own frame, turned askew and made clay.
Result<Scene> make_scene(Distance body, double half_bounds_mm,
                         const std::function<SurfacePoint(Random&, double)>& point_for,
                         double probe_mm = kProbeMm) {
  assert(probe_mm > 0.0 && half_bounds_mm > 0.0);
  Distance distance = turned(kTilt, std::move(body));
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  auto clay = Clay::from_distance(distance, bounds_of(half_bounds_mm), options);
  if (!clay) return clay.error();
  return Scene{std::make_shared<Clay>(std::move(clay).value()), std::move(distance), probe_mm,
               [point_for](Random& random, double radius_mm) {
                 const SurfacePoint p = point_for(random, radius_mm);
                 return SurfacePoint{rotate(kTilt, p.point_mm), rotate(kTilt, p.normal)};
               }};
}

/// Half the diagonal of a box, and room for the band.
double bounds_half(const Vec3& half_mm) { return length(half_mm) + 2.0; }

Result<Scene> plane_scene(double /*radius_mm*/) {
  constexpr double kHalf = 120.0, kRounding = 12.0, kMiddle = 25.0;
  const Vec3 half{kHalf, kHalf, kHalf};
  return make_scene(
      box(half, kRounding), bounds_half(half), [](Random& random, double /*radius_mm*/) {
        return SurfacePoint{
            {random.between(-kMiddle, kMiddle), random.between(-kMiddle, kMiddle), kHalf},
            {0, 0, 1}};
      });
}

Result<Scene> ball_scene(double /*radius_mm*/) {
  constexpr double kRadius = 60.0;
  return make_scene(ball(kRadius), kRadius + 2.0, [](Random& random, double /*radius_mm*/) {
    const Vec3 normal = random.direction();
    return SurfacePoint{kRadius * normal, normal};
  });
}

Result<Scene> torus_scene(double /*radius_mm*/) {
  constexpr double kRing = 60.0, kTube = 24.0;
  return make_scene(
      torus(kRing, kTube), kRing + kTube + 2.0, [](Random& random, double /*radius_mm*/) {
        const double around = random.between(0.0, 2.0 * std::numbers::pi);
        const double along = random.between(0.0, 2.0 * std::numbers::pi);
        const Vec3 outward{std::cos(around), std::sin(around), 0.0};
        const Vec3 normal = std::cos(along) * outward + std::sin(along) * Vec3{0, 0, 1};
        return SurfacePoint{kRing * outward + kTube * normal, normal};
      });
}

/// Near an edge of a block: up to half a radius from it, from any side it can be seen from.
Result<Scene> edge_scene(double /*radius_mm*/) {
  constexpr double kHalf = 120.0, kMiddle = 25.0;
  const Vec3 half{kHalf, kHalf, kHalf};
  return make_scene(box(half, 0.0), bounds_half(half), [](Random& random, double radius_mm) {
    const double turn = random.between(0.0, 0.5 * std::numbers::pi);
    const double inward = random.between(0.0, 0.5 * radius_mm);
    return SurfacePoint{{kHalf - inward, random.between(-kMiddle, kMiddle), kHalf},
                        {std::sin(turn), 0.0, std::cos(turn)}};
  });
}

/// One finest voxel of amplitude at a wavelength of eight.
Result<Scene> rough_scene(double /*radius_mm*/) {
  constexpr double kHalf = 80.0, kDepth = 100.0, kMiddle = 10.0;
  constexpr double kAmplitude = kVoxelMm, kWavelength = 8.0 * kVoxelMm;
  constexpr double kTableStep = kWavelength / 80.0;
  // The table is steep only where its nodes are: half a step keeps to one cell.
  return make_scene(
      rough_box(kHalf, kDepth, kAmplitude, kWavelength), bounds_half({kHalf, kHalf, kDepth}),
      [](Random& random, double /*radius_mm*/) {
        return SurfacePoint{
            {random.between(-kMiddle, kMiddle), random.between(-kMiddle, kMiddle), 0.0}, {0, 0, 1}};
      },
      0.5 * kTableStep);
}

/// Two blocks one radius apart: the tool enters between them from above.
Result<Scene> slot_scene(double radius_mm) {
  assert(radius_mm > 0.0);
  const double half = std::max(4.0 * radius_mm, 12.0);
  const Distance block = box({half, half, half}, 0.0);
  const double middle = half + 0.5 * radius_mm;
  const auto distance = [=](const Vec3& p) {
    return block({std::abs(p.x) - middle, p.y, p.z});  // the nearer of two equal blocks
  };
  return make_scene(
      distance, bounds_half({middle + half, half, half}),
      [=](Random& random, double /*radius_mm*/) {
        const double aside = random.between(-0.5, 0.5) * radius_mm;
        return SurfacePoint{{aside, random.between(-0.5, 0.5) * radius_mm, half}, {0, 0, 1}};
      });
}

/// As thick as the radius of the tool.
Result<Scene> sheet_scene(double radius_mm) {
  assert(radius_mm > 0.0);
  const double side = std::max(4.0 * radius_mm, 12.0);
  const Vec3 half{side, side, 0.5 * radius_mm};
  return make_scene(box(half, 0.0), bounds_half(half), [=](Random& random, double /*radius_mm*/) {
    return SurfacePoint{
        {random.between(-0.5, 0.5) * radius_mm, random.between(-0.5, 0.5) * radius_mm, half.z},
        {0, 0, 1}};
  });
}

}  // namespace

std::vector<SceneRecipe> formula_scenes() {
  // name, group, scales, has detail
  return {{"plane", Group::smooth, false, false, plane_scene},
          {"ball", Group::smooth, false, false, ball_scene},
          {"torus", Group::smooth, false, false, torus_scene},
          {"edge", Group::sharp, false, false, edge_scene},
          {"rough", Group::sharp, false, true, rough_scene},
          {"slot", Group::sharp, true, false, slot_scene},
          {"sheet", Group::sharp, true, false, sheet_scene}};
}

}  // namespace argil::evaluation
