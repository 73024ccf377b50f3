// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces whose surface is known and which are awkward in different ways: smooth everywhere, and
// with sharp edges between flat faces.
#include "decimate/pieces.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "scene/scene.h"

namespace argil::evaluation {
namespace {

ClayOptions chart_options() {
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  return options;
}

Result<void> dab(Clay& clay, Action action, double radius_mm, const Vec3& from, const Vec3& to) {
  Stroke stroke;
  stroke.tool.action = action;
  stroke.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  stroke.samples = {{0.0, from, {}, 1.0}, {1.0, to, {}, 1.0}};
  if (auto applied = clay.apply(stroke); !applied) return applied.error();
  return {};
}

}  // namespace

Result<Clay> wavy_ball(double radius_voxels) {
  constexpr double kHeightMm = 0.75 * kVoxelMm;  // of a crest above the ball, and of a trough below
  // A period of 24 voxels, which the lattice resolves well.
  constexpr double kTurn = 2.0 * std::numbers::pi / (24.0 * kVoxelMm);
  assert(radius_voxels > 0.0);
  const double radius_mm = kVoxelMm * radius_voxels;
  const auto distance = [=](const Vec3& p) {
    return length(p) - radius_mm -
           kHeightMm * std::sin(kTurn * p.x) * std::sin(kTurn * p.y) * std::sin(kTurn * p.z);
  };
  const double half = radius_mm + 3.0 * kVoxelMm;
  return Clay::from_distance(distance, {{-half, -half, -half}, {half, half, half}},
                             chart_options());
}

Result<Clay> sculpted_block(double thickness_voxels) {
  assert(thickness_voxels > 0.0);
  const double unit = kVoxelMm * thickness_voxels / 6.0;
  auto block = Clay::block(unit * Vec3{9.0, 8.0, 6.0}, chart_options());
  if (!block) return block;
  Clay& clay = block.value();
  struct Dab {
    Action action;
    double radius;
    Vec3 from, to;
  };
  for (const Dab& d : {Dab{Action::carve, 1.2, {-3.0, -1.0, 3.0}, {3.0, 2.0, 3.0}},
                       Dab{Action::carve, 2.0, {4.5, 0.0, 0.0}, {4.5, 1.0, 0.0}},
                       Dab{Action::add, 1.5, {-2.0, 2.0, 3.0}, {-1.0, 2.0, 3.0}}}) {
    if (auto done = dab(clay, d.action, unit * d.radius, unit * d.from, unit * d.to); !done) {
      return done.error();
    }
  }
  return block;
}

}  // namespace argil::evaluation
