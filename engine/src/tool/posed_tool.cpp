// SPDX-License-Identifier: GPL-3.0-or-later
// A ball that sweeps from one radius to another is a cone with round ends, whose distance is
// closed; other shapes are a union of poses.
#include "tool/posed_tool.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/engine/tool_mesh.h"

#include "rows/rows.h"
#include "tool/emboss_size.h"

namespace argil {
namespace {

/// Poses this fraction of the smallest radius apart: their union lies within 1/1000 of it, s^2 / 8,
/// of what they sweep.
constexpr double kPieceOfRadius = 0.09;
constexpr int kMostPieces = 32;

/// A value of which pressure scales a fraction.
double pressed(double value, double fraction, double pressure) {
  return value * (1.0 - fraction + fraction * pressure);
}

/// A square tip lies across whatever way the stroke goes; its corners, a ball of the roundness t
/// about a square of the half side 1 - t, are no farther than this.
double reach_of(const Tool& tool) {
  if (tool.action == Action::emboss) return emboss_reach(tool);
  if (tool.action != Action::clay_strips) return 1.0;
  return std::sqrt(1.0 + 2.0 * (1.0 - tool.tip_roundness) / (1.0 + tool.tip_roundness));
}

}  // namespace

PosedTool::PosedTool(const Tool& tool, const Dab& dab)
    : tool_(tool),
      dab_(dab),
      strength_(pressed(tool.strength, tool.pressure_to_strength, dab.at.pressure)),
      radii_mm_(sized(dab.at.pressure)),
      smallest_mm_(smallest_radius(tool) * sized(dab.at.pressure).x / tool.radii_mm.x),
      shrink_mm_(shrink_of(dab.at.pressure)),
      reach_(reach_of(tool)),
      inverse_(conjugate(dab.at.orientation)),
      middle_(is_anchored(tool.action) ? dab.at.position_mm
                                       : 0.5 * (dab.from.position_mm + dab.at.position_mm)) {
  assert(is_finite(dab.from.position_mm) && is_finite(dab.at.position_mm));
  assert(smallest_radius(tool) > 0.0 && std::abs(tool.strength) <= 1.0);
  include_bounds(dab.from);
  include_bounds(dab.at);
  if (tool.shape == Shape::ball) {
    place_ball();
  } else {
    place_pieces();
  }
}

void PosedTool::place_ball() {
  first_radius_mm_ = sized(dab_.from.pressure).x - shrink_of(dab_.from.pressure);
  last_radius_mm_ = radii_mm_.x - shrink_mm_;
  const Vec3 path = dab_.at.position_mm - dab_.from.position_mm;
  const double fall = first_radius_mm_ - last_radius_mm_;
  path_mm_ = length(path);
  if (path_mm_ <= std::abs(fall)) {  // one end contains the other
    if (fall > 0.0) {
      dab_.at.position_mm = dab_.from.position_mm;
      last_radius_mm_ = first_radius_mm_;
    }
    path_mm_ = 0.0;
    return;
  }
  axis_ = path / path_mm_;
  lean_ = fall / std::sqrt((path_mm_ - fall) * (path_mm_ + fall));
}

Vec3 PosedTool::sized(double pressure) const noexcept {
  return tool_.radii_mm * pressed(1.0, tool_.pressure_to_size, pressure);
}

double PosedTool::shrink_of(double pressure) const noexcept {
  const double strength = pressed(tool_.strength, tool_.pressure_to_strength, pressure);
  const double smallest = pressed(smallest_radius(tool_), tool_.pressure_to_size, pressure);
  return (1.0 - std::abs(strength)) * smallest;
}

double PosedTool::deepest_mm() const noexcept {
  const double from_pressure = pressed(1.0, tool_.pressure_to_size, dab_.from.pressure);
  const double from_mm = smallest_radius(tool_) * from_pressure - shrink_of(dab_.from.pressure);
  return std::max(shrunk_radius_mm(), from_mm);
}

/// The half widths of a rotated ellipsoid's bounds are the lengths of the rows of R diag(radii); a
/// box's and a mesh's their sums. A square tip has any orientation.
void PosedTool::include_bounds(const DabPose& pose) {
  const Vec3 radii = sized(pose.pressure);
  const Vec3 x = rotate(pose.orientation, Vec3{radii.x, 0.0, 0.0});
  const Vec3 y = rotate(pose.orientation, Vec3{0.0, radii.y, 0.0});
  const Vec3 z = rotate(pose.orientation, Vec3{0.0, 0.0, radii.z});
  const bool is_round = tool_.shape == Shape::ball || tool_.shape == Shape::ellipsoid;
  Vec3 half;
  for (std::size_t a = 0; a < 3; ++a) {
    half[a] = is_round ? length(Vec3{x[a], y[a], z[a]})
                       : std::abs(x[a]) + std::abs(y[a]) + std::abs(z[a]);
    if (reach_ != 1.0) half[a] = reach_ * std::max({radii.x, radii.y, radii.z});
  }
  bounds_.include(pose.position_mm - half);
  bounds_.include(pose.position_mm + half);
}

void PosedTool::place_pieces() {
  const double path = length(dab_.at.position_mm - dab_.from.position_mm);
  const double turn = length(rotate(dab_.at.orientation, Vec3{1, 1, 1}) -
                             rotate(dab_.from.orientation, Vec3{1, 1, 1})) *
                      largest_radius(tool_);
  const double wanted = std::ceil((path + turn) / (kPieceOfRadius * smallest_radius(tool_)));
  const int count = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostPieces)));
  for (int i = wanted > 0.0 ? 0 : 1; i <= count; ++i) {
    const DabPose at = i == count ? dab_.at : between(dab_.from, dab_.at, 1.0 * i / count);
    pieces_.push_back(
        {at.position_mm, conjugate(at.orientation), sized(at.pressure), shrink_of(at.pressure)});
  }
}

double PosedTool::placed_distance(const Placed& at, const Vec3& point_mm) const noexcept {
  const Vec3 p = rotate(at.inverse, point_mm - at.center);
  switch (tool_.shape) {
    case Shape::box:
      return box_distance(p, at.radii_mm - Vec3{at.shrink_mm, at.shrink_mm, at.shrink_mm});
    case Shape::capsule:
      return capsule_distance(p, at.radii_mm) + at.shrink_mm;
    case Shape::mesh:
      return tool_.mesh->distance(p, at.radii_mm) + at.shrink_mm;
    case Shape::ball:
    case Shape::ellipsoid:
      break;
  }
  return ellipsoid_distance(p, at.radii_mm) + at.shrink_mm;
}

double PosedTool::nearest_on_path(const Vec3& from) const noexcept {
  const double along = dot(from, axis_);
  double fraction = along;
  if (lean_ != 0.0) fraction -= lean_ * std::sqrt(std::max(0.0, dot(from, from) - along * along));
  return std::clamp(fraction / path_mm_, 0.0, 1.0);
}

double PosedTool::ball_distance(const Vec3& point_mm) const noexcept {
  if (path_mm_ == 0.0) return length(point_mm - dab_.at.position_mm) - last_radius_mm_;
  const Vec3 from = point_mm - dab_.from.position_mm;
  const double fraction = nearest_on_path(from);
  const double radius = first_radius_mm_ + fraction * (last_radius_mm_ - first_radius_mm_);
  return length(from - (fraction * path_mm_) * axis_) - radius;
}

double PosedTool::shrunk_distance(const Vec3& point_mm) const noexcept {
  if (tool_.shape == Shape::ball) return ball_distance(point_mm);
  assert(!pieces_.empty());
  double nearest = placed_distance(pieces_.back(), point_mm);
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    nearest = std::min(nearest, placed_distance(pieces_[i], point_mm));
  }
  return nearest;
}

/// Of a cone as of a ball: what is nearest on the path does not move, to first order.
Vec3 PosedTool::slope(const Vec3& point_mm) const noexcept {
  Vec3 slope;
  if (tool_.shape == Shape::ball) {
    slope = point_mm - dab_.at.position_mm;
    if (path_mm_ != 0.0) {
      const Vec3 from = point_mm - dab_.from.position_mm;
      slope = from - (nearest_on_path(from) * path_mm_) * axis_;
    }
  } else {
    const Placed* nearest = &pieces_.front();
    double least = placed_distance(*nearest, point_mm);
    for (std::size_t n = 1; n < pieces_.size(); ++n) {
      const double distance = placed_distance(pieces_[n], point_mm);
      if (distance >= least) continue;
      least = distance;
      nearest = &pieces_[n];
    }
    const double step = 1e-3 * smallest_mm_;
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 low = point_mm;
      Vec3 high = point_mm;
      low[a] -= step;
      high[a] += step;
      slope[a] = placed_distance(*nearest, high) - placed_distance(*nearest, low);
    }
  }
  const double size = length(slope);
  return size > 0.0 ? slope / size : Vec3{0.0, 0.0, 1.0};
}

void PosedTool::shrunk_distances(const Coord& origin, double voxel_mm,
                                 LeafValues& out) const noexcept {
  assert(is_leaf_origin(origin));
  if (tool_.shape != Shape::ball || lean_ != 0.0) {
    for (std::size_t n = 0; n < out.size(); ++n) {
      out[n] = static_cast<float>(shrunk_distance(node_mm(node_of(origin, n), voxel_mm)));
    }
    return;
  }
  // Where a ball stays, `axis_` is zero, and so is the step along it to the nearest point.
  const Vec3& start = path_mm_ == 0.0 ? dab_.at.position_mm : dab_.from.position_mm;
  BallJob job{
      {},
      {},
      static_cast<float>(voxel_mm * origin.z() - start.z),
      static_cast<float>(voxel_mm),
      {static_cast<float>(axis_.x), static_cast<float>(axis_.y), static_cast<float>(axis_.z)},
      static_cast<float>(path_mm_),
      static_cast<float>(last_radius_mm_)};
  for (int i = 0; i < kLeafSide; ++i) {
    job.x[i] = static_cast<float>(voxel_mm * (origin.x() + i) - start.x);
    job.y[i] = static_cast<float>(voxel_mm * (origin.y() + i) - start.y);
  }
  row_loops().ball_distances(job, out.data());
}

Vec3 PosedTool::in_radii(const Vec3& vector_mm) const noexcept {
  assert(smallest_mm_ > 0.0);
  Vec3 own = tool_.shape == Shape::ball ? vector_mm : rotate(inverse_, vector_mm);
  for (std::size_t a = 0; a < 3; ++a) own[a] /= radii_mm_[a];
  return own;
}

Vec3 PosedTool::from_radii(const Vec3& vector) const noexcept {
  Vec3 own = vector;
  for (std::size_t a = 0; a < 3; ++a) own[a] *= radii_mm_[a];
  return tool_.shape == Shape::ball ? own : rotate(dab_.at.orientation, own);
}

double PosedTool::falloff(const Vec3& point_mm) const noexcept {
  if (smallest_mm_ <= 0.0) return 0.0;
  const Vec3 p = in_radii(point_mm - middle_);
  return fall_off(tool_.falloff, dot(p, p));
}

Vec3 turned(const Dab& image, Vec3 vector) noexcept {
  if (image.is_mirrored) vector.x = -vector.x;
  return rotate(image.turn, vector);
}

Vec3 unturned(const Dab& image, const Vec3& vector) noexcept {
  Vec3 back = rotate(conjugate(image.turn), vector);
  if (image.is_mirrored) back.x = -back.x;
  return back;
}

Cover cover_of(const Coord& origin, double voxel_mm, double band_mm,
               const PosedTool& tool) noexcept {
  assert(is_leaf_origin(origin));
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm;
  const Vec3 middle{voxel_mm * origin.x() + half, voxel_mm * origin.y() + half,
                    voxel_mm * origin.z() + half};
  const double distance = tool.shrunk_distance(middle);
  const double reach = half * std::sqrt(3.0) + band_mm;
  if (distance > reach) return Cover::none;
  return distance < -reach ? Cover::all : Cover::some;
}

}  // namespace argil
