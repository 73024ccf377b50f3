// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/field_sampler.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "raycast/field_ray.h"
#include "raycast/octant_store.h"

namespace argil {
namespace {

/// How far a point of the surface may lie: at a sharp edge through lattice nodes phi = 0 is 0.71
/// voxel from the triangle that cuts the corner off, at a corner 0.82; beyond is another sheet.
constexpr double kReachVoxels = 0.875;

}  // namespace

namespace {

/// std::floor is a call where the processor may lack the instruction. Farther out than any node all
/// places are one: an int does not hold them.
int floor_of(double x) noexcept {
  constexpr double kBeyond = 1e9;
  const double near = std::min(std::max(x, -kBeyond), kBeyond);
  const int toward_zero = static_cast<int>(near);
  return toward_zero - (static_cast<double>(toward_zero) > near ? 1 : 0);
}

}  // namespace

struct FieldSampler::State {
  explicit State(const LevelStack& levels)
      : stack(levels), octants(levels), per_mm(1.0 / levels.voxel_mm(0)) {}

  /// Where a point lies in its cell, which becomes `cell`: points that follow one another mostly
  /// share one.
  void find(const Vec3& point_mm);

  const LevelStack& stack;
  OctantStore octants;
  double per_mm;       ///< cells of level 0
  FieldCell cell;      ///< of the last point
  Coord node;          ///< its low corner; where the cell has a level of its own
  double scale = 0.0;  ///< cells of its level in one of level 0; 0: no point was asked for
  Trilinear field{{}};
};

void FieldSampler::State::find(const Vec3& point_mm) {
  assert(is_finite(point_mm));
  const Vec3 at = per_mm * point_mm;
  const Coord finest(floor_of(at.x), floor_of(at.y), floor_of(at.z));
  // No finer level begins within a cell: a finer leaf covers an octant of the coarser one, whole
  // cells.
  const bool is_same = scale != 0.0 && (finest >> cell.level) == node;
  const int level = is_same ? cell.level : octants.finest_level(finest);
  if (level < 0) {
    cell = {};
    cell.corners.fill(stack.sample(stack.top(), finest >> stack.top()));
    cell.level = stack.top();
    field = Trilinear(cell.corners);
    scale = 0.0;
    return;
  }
  if (!is_same) {
    node = finest >> level;
    scale = 1.0 / (1 << level);
    cell.corners = octants.corners(level, node);
    cell.level = level;
    cell.per_mm = scale * per_mm;
    field = Trilinear(cell.corners);
  }
  cell.fraction = scale * at - Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                    static_cast<double>(node.z())};
}

FieldSampler::FieldSampler(const Clay& clay) : state_(std::make_unique<State>(levels_of(clay))) {}
FieldSampler::~FieldSampler() = default;

FieldCell FieldSampler::cell_at(const Vec3& point_mm) {
  state_->find(point_mm);
  return state_->cell;
}

double FieldSampler::distance_mm(const Vec3& point_mm) {
  state_->find(point_mm);
  return state_->field.value(state_->cell.fraction);
}

FieldValue FieldSampler::value(const Vec3& point_mm) {
  state_->find(point_mm);
  const auto& [corners, fraction, per_mm, level] = state_->cell;
  return {state_->field.value(fraction), per_mm * state_->field.slope(fraction),
          state_->stack.voxel_mm(level)};
}

std::optional<Vec3> FieldSampler::sign_change(const Vec3& point_mm, const FieldValue& at) {
  constexpr int kProbes = 14;
  constexpr int kHalvings = 8;
  constexpr double kJumpVoxels = 0.01;
  const double side = at.distance_mm > 0.0 ? -1.0 : 1.0;
  const Vec3 step = (side * kReachVoxels * at.voxel_mm / kProbes) * normalized(at.gradient);
  for (int i = 1; i <= kProbes; ++i) {
    if ((distance_mm(point_mm + i * step) > 0.0) == (at.distance_mm > 0.0)) continue;
    double before = i - 1.0;
    double behind = i;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = 0.5 * (before + behind);
      const bool same = (distance_mm(point_mm + middle * step) > 0.0) == (at.distance_mm > 0.0);
      (same ? before : behind) = middle;
    }
    // Where levels meet phi may jump across zero: that is no point of the surface.
    const Vec3 point = point_mm + behind * step;
    if (std::abs(distance_mm(point)) > kJumpVoxels * at.voxel_mm) return std::nullopt;
    return point;
  }
  return std::nullopt;
}

std::optional<Vec3> FieldSampler::on_surface(const Vec3& point_mm) {
  constexpr int kMostSteps = 4;
  constexpr double kGoodVoxels = 0.001;
  constexpr double kLeastSteepness = 0.0625;  // squared; on a level field a step leads anywhere
  const FieldValue start = value(point_mm);
  FieldValue at = start;
  Vec3 point = point_mm;
  for (int i = 0;; ++i) {
    if (std::abs(at.distance_mm) <= kGoodVoxels * at.voxel_mm) break;
    const double steepness = dot(at.gradient, at.gradient);
    if (i == kMostSteps || steepness < kLeastSteepness) return sign_change(point_mm, start);
    point -= (at.distance_mm / steepness) * at.gradient;
    at = value(point);
  }
  const Vec3 moved = point - point_mm;
  const double reach_mm = kReachVoxels * start.voxel_mm;
  if (dot(moved, moved) > reach_mm * reach_mm) return sign_change(point_mm, start);
  return point;
}

struct RayExits::State {
  FieldExits exits;
};

RayExits::RayExits(const Clay& clay) : state_(new State{FieldExits(levels_of(clay))}) {}
RayExits::~RayExits() = default;

std::optional<double> RayExits::first_voxels(const Vec3& origin_voxels,
                                             const Vec3& direction) const {
  assert(is_finite(origin_voxels) && std::abs(dot(direction, direction) - 1.0) < 1e-9);
  const std::optional<FieldEntry> exit = state_->exits.first(origin_voxels, direction);
  if (!exit) return std::nullopt;
  return exit->along;
}

}  // namespace argil
