// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush/profile_piece.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil {
namespace {

/// How deep the middle is at full strength, in smallest radii: as far as inflate's whole pass.
constexpr double kProfileDepth = 0.25;
/// A parabola and no corner, however sharp: its formula divides by this.
constexpr double kLeastRound = 1e-3;

double depth_of(const PosedTool& tool) {
  return kProfileDepth * std::abs(tool.strength()) * tool.smallest_radius_mm();
}

/// Without pressure the tool may have no size.
double half_width_of(const PosedTool& tool) {
  const double least = 1e-3 * smallest_radius(tool.tool());
  return tool.tool().width * std::max(tool.smallest_radius_mm(), least);
}

}  // namespace

ProfilePiece::ProfilePiece(const PosedTool& tool, const LocalPlane& plane, double side,
                           double least_round_mm)
    : from_(tool.dab().from.position_mm), normal_(plane.normal), side_(side) {
  assert(std::abs(side) == 1.0 && least_round_mm > 0.0);
  assert(std::abs(dot(normal_, normal_) - 1.0) < 1e-6);
  const Vec3 whole = tool.dab().at.position_mm - from_;
  path_ = whole - dot(whole, normal_) * normal_;
  above_ = plane.distance(from_);
  const PosedTool begin(tool.tool(), {tool.dab().from, tool.dab().from});
  reach_ = std::max(begin.smallest_radius_mm(), tool.smallest_radius_mm());
  most_depth_ = std::max(depth_of(begin), depth_of(tool));
  most_width_ = std::max(half_width_of(begin), half_width_of(tool));
  round_ = std::clamp(std::max(1.0 - tool.tool().sharpness, least_round_mm / most_width_),
                      kLeastRound, 1.0);
  ends_ = {end_of(begin), end_of(tool)};
}

/// As deep as it is asked to be, however round.
ProfilePiece::End ProfilePiece::end_of(const PosedTool& tool) const noexcept {
  const double rest = 1.0 - 0.5 * round_;
  return {depth_of(tool) / (rest * rest), half_width_of(tool)};
}

ProfilePiece::Place ProfilePiece::place_of(const Vec3& point_mm) const noexcept {
  const Vec3 here = point_mm - from_;
  const double up = dot(here, normal_);
  const Vec3 flat = here - up * normal_;
  const double square = dot(path_, path_);
  const double along = square > 0.0 ? std::clamp(dot(flat, path_) / square, 0.0, 1.0) : 0.0;
  return {length(flat - along * path_), up};
}

/// As rows/profile_impl.h.
double ProfilePiece::sunk_mm(const Vec3& point_mm) const noexcept {
  const Vec3 here = point_mm - from_;
  const Vec3 flat = here - dot(here, normal_) * normal_;
  const double square = dot(path_, path_);
  const double along = square > 0.0 ? std::clamp(dot(flat, path_) / square, 0.0, 1.0) : 0.0;
  const auto at = [along](double begin, double end) { return begin + along * (end - begin); };
  const double x = length(flat - along * path_) / at(ends_[0].half_width, ends_[1].half_width);
  if (x >= 1.0) return 0.0;
  const double rest = 1.0 - (x < round_ ? 0.5 * (x * x / round_ + round_) : x);
  return at(ends_[0].scale, ends_[1].scale) * rest * rest;
}

Box3 ProfilePiece::bounds_mm(double beside_mm, double up_mm) const noexcept {
  const Vec3 on_plane = from_ - above_ * normal_;
  Box3 box;
  box.include(on_plane);
  box.include(on_plane + path_);
  for (std::size_t a = 0; a < 3; ++a) {
    const double along = std::abs(normal_[a]);
    const double by = beside_mm * std::sqrt(std::max(0.0, 1.0 - along * along)) + up_mm * along;
    box.min[a] -= by;
    box.max[a] += by;
  }
  return box;
}

ProfileJob ProfilePiece::job_of(const Coord& origin, double voxel_mm, float band_mm,
                                float known_mm) const noexcept {
  assert(is_leaf_origin(origin) && voxel_mm > 0.0);
  const Vec3 first = node_mm(origin, voxel_mm) - from_;
  ProfileJob job{};
  for (std::size_t a = 0; a < 3; ++a) {
    job.first[a] = static_cast<float>(first[a]);
    job.normal[a] = static_cast<float>(normal_[a]);
    job.path[a] = static_cast<float>(path_[a]);
  }
  const double square = dot(path_, path_);
  job.voxel = static_cast<float>(voxel_mm);
  job.inverse_square = square > 0.0 ? static_cast<float>(1.0 / square) : 0.0F;
  job.above = static_cast<float>(above_);
  job.scale[0] = static_cast<float>(ends_[0].scale);
  job.scale[1] = static_cast<float>(ends_[1].scale - ends_[0].scale);
  job.width[0] = static_cast<float>(ends_[0].half_width);
  job.width[1] = static_cast<float>(ends_[1].half_width - ends_[0].half_width);
  job.round = static_cast<float>(round_);
  job.inverse_reach = static_cast<float>(1.0 / reach_);
  job.side = static_cast<float>(side_);
  job.deepest = static_cast<float>(most_depth_);
  job.band = band_mm;
  job.known = known_mm;
  return job;
}

}  // namespace argil
