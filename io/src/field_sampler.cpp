// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_sampler.h"

#include <cmath>

#include "trilinear.h"

namespace argil::io {
namespace {

/// How far a place of the surface may lie: at a sharp edge through lattice nodes phi = 0 is 0.71
/// voxel from the triangle that cuts the corner off, at a corner 0.82; beyond is another sheet.
constexpr double kReachVoxels = 0.875;

}  // namespace

FieldCell FieldSampler::cell_at(const Vec3& place_mm) {
  const Vec3 at = per_mm_ * place_mm;
  const auto low = [](double x) { return static_cast<int>(std::floor(x)); };
  const Coord finest(low(at.x), low(at.y), low(at.z));
  const int level = cells_.finest_level(finest);
  FieldCell cell;
  if (level < 0) {
    cell.corners.fill(stack_.sample(stack_.top(), finest >> stack_.top()));
    cell.level = stack_.top();
    return cell;
  }
  cell.level = level;
  cells_.open(level, finest);
  const Coord node = finest >> level;
  cell.corners = cells_.corners(node);
  const double scale = std::ldexp(1.0, -level);
  cell.share = scale * at - Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                 static_cast<double>(node.z())};
  cell.per_mm = scale * per_mm_;
  return cell;
}

double FieldSampler::distance_mm(const Vec3& place_mm) {
  const FieldCell cell = cell_at(place_mm);
  return Trilinear(cell.corners).value(cell.share);
}

FieldValue FieldSampler::value(const Vec3& place_mm) {
  const FieldCell cell = cell_at(place_mm);
  const Trilinear field(cell.corners);
  return {field.value(cell.share), cell.per_mm * field.slope(cell.share),
          stack_.voxel_mm(cell.level)};
}

std::optional<Vec3> FieldSampler::sign_change(const Vec3& place_mm, const FieldValue& at) {
  constexpr int kProbes = 14;
  constexpr int kHalvings = 8;
  constexpr double kJumpVoxels = 0.01;
  const double side = at.distance_mm > 0.0 ? -1.0 : 1.0;
  const Vec3 way = (side * kReachVoxels * at.voxel_mm / kProbes) * normalized(at.gradient);
  for (int i = 1; i <= kProbes; ++i) {
    if ((distance_mm(place_mm + i * way) > 0.0) == (at.distance_mm > 0.0)) continue;
    double before = i - 1.0;
    double behind = i;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = 0.5 * (before + behind);
      const bool same = (distance_mm(place_mm + middle * way) > 0.0) == (at.distance_mm > 0.0);
      (same ? before : behind) = middle;
    }
    // Where levels meet phi may jump across zero: that is no place of the surface.
    const Vec3 place = place_mm + behind * way;
    if (std::abs(distance_mm(place)) > kJumpVoxels * at.voxel_mm) return std::nullopt;
    return place;
  }
  return std::nullopt;
}

std::optional<Vec3> FieldSampler::on_surface(const Vec3& place_mm) {
  constexpr int kMostSteps = 4;
  constexpr double kGoodVoxels = 0.001;
  constexpr double kLeastSteepness = 0.0625;  // squared; on a level field a step leads anywhere
  const FieldValue start = value(place_mm);
  FieldValue at = start;
  Vec3 place = place_mm;
  for (int i = 0;; ++i) {
    if (std::abs(at.distance_mm) <= kGoodVoxels * at.voxel_mm) break;
    const double steepness = dot(at.gradient, at.gradient);
    if (i == kMostSteps || steepness < kLeastSteepness) return sign_change(place_mm, start);
    place -= (at.distance_mm / steepness) * at.gradient;
    at = value(place);
  }
  const Vec3 way = place - place_mm;
  const double reach_mm = kReachVoxels * start.voxel_mm;
  if (dot(way, way) > reach_mm * reach_mm) return sign_change(place_mm, start);
  return place;
}

}  // namespace argil::io
